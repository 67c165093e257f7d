#!/bin/sh
# `make install` leaves a program that runs, and headers, a library and a
# pkg-config file with which a foreign program builds.
set -eu
[ "$B" = build ] || { echo 'only for the plain build'; exit 77; }
unset MAKEFLAGS MAKELEVEL
root=$TMPDIR/root
make --no-print-directory install DESTDIR="$root" PREFIX=/usr

for file in bin/brume lib/libbrume.a lib/brume/brume_vdb.so \
    include/brume/brume.h \
    share/brume/scenes/quickstart.pov share/man/man1/brume.1; do
    [ -e "$root/usr/$file" ] || { echo "no $file"; exit 1; }
done

# The suite's own program without the parser, as a stranger would build it.
sed 's|"core/brume.h"|<brume/brume.h>|' tests/unit/test_api.c \
    >"$TMPDIR/foreign.c"
cp tests/data/kinds.vdb "$TMPDIR"
export PKG_CONFIG_PATH="$root/usr/lib/pkgconfig"
cd "$TMPDIR"
# shellcheck disable=SC2046 # a list of flags
cc -std=c11 foreign.c -o foreign $(pkg-config --cflags --libs brume cmocka) -lm
./foreign >/dev/null

version=$(pkg-config --modversion brume)
root/usr/bin/brume --version | grep -F "$version"
root/usr/bin/brume root/usr/share/brume/scenes/quickstart.pov \
    +W32 +H24 --spp 1 +Oinstalled.exr
[ -s installed.exr ]

cat >cloud.pov <<END
box { 0, 1 hollow material { interior { media {
  density { density_file vdb "kinds.vdb" "real" } } } } }
END
root/usr/bin/brume --check cloud.pov
