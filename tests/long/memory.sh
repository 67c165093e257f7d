#!/bin/sh
# A sparse medium of 1024^3 voxels, 1 % of them filled, renders in less than 8
# GiB of address space, by path, photon and preset paper; and a field of photons
# that would not fit into --memory gets cells that do.
. "$(dirname "$0")/../cli/lib"
sparse=$ROOT/${B:-build}/tests/bench/sparse
[ -x "$sparse" ] || { echo "no program '$sparse'"; exit 77; }
# Sanitizers take address space of their own.
! grep -q __asan_init "$BRUME" || { echo 'with sanitizers'; exit 77; }

cat >scene.pov <<'END'
#version 3.7;
global_settings {
    assumed_gamma 1
    transport { media multiple surfaces indirect environment off }
}
camera { location -4 * z angle 40 look_at 0 }
light_source { <-4, 5, -4> rgb 3 parallel point_at 0 }
box {
    -1, 1
    hollow
    pigment { rgbt 1 }
    interior {
        media {
            density { density_file vdb "sparse.vdb" "density" }
            scattering { 1, rgb 30 }
            absorption rgb 1
        }
    }
}
END

new_case 'a grid of 1024^3 voxels, 1 % filled'
"$sparse" sparse.vdb >row || complain 'sparse failed'
grep -q '^1024^3 voxels, .* stored: \(0\.9\|1\.[0-4]\)[0-9] %' row ||
    complain "$(cat row)"

eight=$((8 * 1024 * 1024))
for way in path photon 'photon --preset paper'; do
    new_case "$way renders it in 8 GiB"
    # shellcheck disable=SC2086,SC2154,SC3045
    (ulimit -v $eight && brume scene.pov +W160 +H120 --spp 4 --backend cpu \
        --integrator $way --photons 300000 --stats stats +Oout.ppm +FP &&
        exit "$status")
    took $?
    exits 0
    [ "$(tail -c 57600 out.ppm | od -An -tu1 -v | tr -s " " "\n" | sort -n | tail -n 1)" -gt 20 ] || complain "the picture is black"
done

command -v python3 >/dev/null || end_cases
new_case 'the field and the photons stay within --memory'
cat >peak.py <<'END'
import resource, subprocess, sys
done = subprocess.run(sys.argv[2:])
with open(sys.argv[1], "w") as f:
    f.write(f"{resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss}\n")
sys.exit(done.returncode)
END
json=$ROOT/${B:-build}/tests/tools/json
# The program itself, and what reading a grid takes beside it, in KiB.
beside=$((64 * 1024))
for memory in 200 300 free; do
    limit="--memory ${memory}M"
    [ $memory != free ] || limit=
    # shellcheck disable=SC2086
    python3 peak.py peak "$BRUME" scene.pov +W32 +H24 --spp 2 --backend cpu \
        --integrator photon --photons 20000 --field-spacing 0.004 $limit \
        --stats stats +Oout.ppm +FP -V >printed 2>said
    took $?
    exits 0
    peak=$(cat peak)
    if [ $memory = free ]; then
        [ "$peak" -gt $((300 * 1024 + beside)) ] ||
            complain "without --memory it took $peak KiB"
        continue
    fi
    [ "$peak" -le $((memory * 1024 + beside)) ] ||
        complain "--memory ${memory}M: it took $peak KiB"
    [ "$("$json" stats frames 0 bytes)" -le $((memory * 1048576)) ] ||
        complain "--memory ${memory}M: it tells of more"
done

end_cases
