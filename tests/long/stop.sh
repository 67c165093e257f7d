#!/bin/sh
# A signal ends a run within 5 s, with 75, whatever it is at.
. "$(dirname "$0")/../cli/lib"

# stops NAME PAUSE WORD...: told to stop after a pause, while it is at NAME.
stops()
{
    new_case "stopped while it is at $1"
    pause=$2
    shift 2
    "$BRUME" "$@" +Oout.png >printed 2>said &
    pid=$!
    sleep "$pause"
    start=$(date +%s%N)
    kill -TERM $pid
    wait $pid
    took $?
    ms=$((($(date +%s%N) - start) / 1000000))
    exits 75
    [ $ms -lt 5000 ] || complain 'it took too long'
    lacks out.png
    echo "# $ms ms"
}

cat >eye.inc <<'END'
camera { location <0, 1.5, -4> look_at 0 }
light_source { <9, 9, -9> rgb 2 }
END
cat >fog.inc <<'END'
sphere {
    0, 1
    hollow pigment { rgbt 1 }
    interior { media { scattering { 1, rgb 9 } absorption 0.1 } }
}
END
{
    cat eye.inc
    echo '#declare I = 0; #while (1) #declare I = I + 1; #end'
} >loop.pov
{
    cat eye.inc
    echo 'height_field { function 1200, 1200 { pattern { bumps scale 0.05 } } }'
} >heights.pov
cat eye.inc fog.inc >fog.pov

stops 'directives' 1 loop.pov
stops 'a mesh of 3 M triangles' 1 heights.pov +W32 +H24
stops 'its tree' 6 heights.pov +W32 +H24
stops 'photons' 2 fog.pov +W32 +H24 --transport full --integrator photon \
    --photons 2000000000
stops 'samples of a large picture' 2 fog.pov +W4000 +H3000 --transport full \
    --spp 1000
stops 'samples of a small one' 2 fog.pov +W80 +H60 --transport full \
    --spp 60000
stops 'a field for each sample' 2 fog.pov +W80 +H60 --transport full \
    --integrator progressive --photons 20000000 --spp 1000

end_cases
