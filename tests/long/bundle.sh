#!/bin/sh
# The bundle, unpacked at another place, runs with nothing but glibc, and is
# at most 16 MiB without scene data.
set -eu
[ "$B" = build ] || { echo 'only for the plain build'; exit 77; }
unset MAKEFLAGS MAKELEVEL
make --no-print-directory bundle
tar -C "$TMPDIR" -xf build/bundle.tar.xz
cd "$TMPDIR/bundle"

outside=$(ldd bin/brume | awk '$3 ~ /^\// { print $3 }' |
    grep -vE "^$PWD/|/lib(c|m)\.so") || true
[ -z "$outside" ] || { echo "uses $outside"; exit 1; }

env -i bin/brume share/brume/scenes/quickstart.pov +W32 +H24 --spp 1 \
    +O"$TMPDIR/bundled.exr"
[ -s "$TMPDIR/bundled.exr" ]

rm -r share/brume/scenes
size=$(tar -cf - . | xz -T0 -9 | wc -c)
echo "$size bytes without scenes"
[ "$size" -le 16777216 ]
