#!/bin/sh
# The bundle, unpacked at another place, runs with nothing but glibc, and is
# at most 16 MiB without scene data.
set -eu
[ "$B" = build ] || { echo 'only for the plain build'; exit 77; }
unset MAKEFLAGS MAKELEVEL
make --no-print-directory bundle
tar -C "$TMPDIR" -xf build/bundle.tar.xz
cp tests/data/kinds.vdb "$TMPDIR"
cd "$TMPDIR/bundle"

# What is loaded while a scene with an OpenVDB file is read.
cat >"$TMPDIR/cloud.pov" <<END
box { 0, 1 hollow material { interior { media {
  density { density_file vdb "kinds.vdb" "real" } } } } }
END
env -i LD_DEBUG=files LD_DEBUG_OUTPUT="$TMPDIR/loaded" \
    bin/brume --check "$TMPDIR/cloud.pov"
sed -n 's/.*calling init: //p' "$TMPDIR"/loaded.* >"$TMPDIR/names"
grep -q '/libopenvdb' "$TMPDIR/names"
outside=$(grep -vE "^$PWD/|/(ld-linux-x86-64|lib[cm])\.so" \
    "$TMPDIR/names") || true
[ -z "$outside" ] || { echo "uses $outside"; exit 1; }

env -i bin/brume share/brume/scenes/quickstart.pov +W32 +H24 --spp 1 \
    +O"$TMPDIR/bundled.exr"
[ -s "$TMPDIR/bundled.exr" ]

rm -r share/brume/scenes
size=$(tar -cf - . | xz -T0 -9 | wc -c)
echo "$size bytes without scenes"
[ "$size" -le 16777216 ]
