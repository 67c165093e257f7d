#!/bin/sh
# A million rays at each of three meshes, one of 1.5 million triangles: BVH,
# kd-tree with any stack, and both together find the same.
trees=${B:-build}/tests/bench/trees
cd "$(dirname "$0")/../.." || exit 2
[ -x "$trees" ] || { echo "no program '$trees'"; exit 77; }
"$trees"
