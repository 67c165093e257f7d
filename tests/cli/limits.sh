#!/bin/sh
# Each limit of reading a scene has a switch, a diagnostic and exit code 3; and
# scenes that want ever more end by them, soon.
. "$(dirname "$0")/lib"

# Reads a scene of one line.
try()
{
    echo "$1" >t.pov
    shift
    brume t.pov --check "$@"
}

new_case 'files within files'
echo '#include "self.inc"' >self.inc
try '#include "self.inc"' --include-depth 5
exits 3
says 'files are included deeper than 5'
try '#include "self.inc"'
exits 3
says 'files are included deeper than 64'

new_case 'macros within macros'
try '#macro M() M() #end M()' --macro-depth 7
exits 3
says 'macros are called deeper than 7'
try '#macro M() M() #end M()'
exits 3
says 'macros are called deeper than 65536'

new_case 'loops'
try '#while (1) #end' --iterations 1000
exits 3
says 'run more than 1000 times'
try '#for (I, 1, 2e9) #end' --iterations 1000
exits 3
try '#for (I, 1, 999) #end' --iterations 1000
exits 0

new_case 'tokens'
try '#while (1) #declare A = 1 + 1; #end' --tokens 5000
exits 3
says 'more than 5000 tokens'
try '#while (1) #declare A = x + y; #end' --tokens 5000
exits 3
says 'more than 5000 tokens'

new_case 'time'
try '#while (1) #end' --parse-time 0.05
exits 3
says 'takes longer than 0.05 s'

new_case 'memory'
try '#declare A = array[1000000];' --memory 1M
exits 3
says 'more than the 1048576 bytes'
head -c 3000000 /dev/zero | tr '\0' ' ' >t.pov
brume t.pov --check --memory 1M
exits 3
says 'the texts need more than 1048576 bytes'

# Within a quarter of a gigabyte, whatever it is that grows.
grows()
{
    echo "$1" >t.pov
    "$BRUME" t.pov --check --memory 100M >printed 2>said </dev/null &
    pid=$!
    most=0
    while kill -0 $pid 2>/dev/null; do
        now=$(sed -n 's/^VmHWM: *\([0-9]*\) kB/\1/p' /proc/$pid/status \
            2>/dev/null)
        [ "${now:-0}" -le $most ] || most=$now
        sleep 0.02
    done
    wait $pid
    took $?
    exits 3 6
    [ "$most" -lt 500000 ] || complain "it took $most kB"
}

new_case 'strings that grow'
grows '#declare S = "ab"; #while (1) #declare S = concat(S, S); #end'
grows '#declare S = "ab"; #while (1) #declare S = concat(S, "x"); #end'
grows '#while (1) #declare S = str(1, 300, 300); #end'

new_case 'arrays that grow'
grows '#while (1) #declare A = array[10000]; #end'
grows '#declare A = array[2]; #while (1) #declare B = array[2] {A, A} #declare A = B; #end'

new_case 'macros that nest'
grows '#macro M(A) #local B = array[1000]; M(concat(A, A)) #end M("abc")'

new_case 'names without end'
grows '#for (I, 1, 1e9) #fopen F "t.inc" write #write (F, "#declare N", I, " = ", I, ";") #fclose F #include "t.inc" #end'

new_case 'random streams without end'
grows '#while (1) #declare R = seed(1); #end'

new_case 'objects without end'
grows '#while (1) sphere { 0, 1 } #end'
grows '#declare I = 0; #while (1) #declare I = I + 1; sphere { I, 1 pigment { rgb I } } #end'
grows 'union { #while (1) sphere { 0, 1 } #end }'
grows 'mesh { #while (1) triangle { x, y, z } #end }'
grows '#while (1) #declare S = sphere { 0, 1 } #end'
grows '#while (1) light_source { 0, 1 } #end'

end_cases
