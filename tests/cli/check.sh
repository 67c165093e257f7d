#!/bin/sh
# --check: every error, not only the first, and all of it as JSON.
. "$(dirname "$0")/lib"
json=$ROOT/${B:-build}/tests/tools/json
cat >s.pov <<'END'
#declare R = 1 + Missing;
sphere { 0, R pigmnt { color rgb 1 } finish { phng 0.9 ambient 0.2 } }
box { 0, 1 pigment { rgb 2 colour } rotate "a" }
#macro M(A) sphere { A, Missing } #end
M(1)
light_source { 0, rgb 1 fade_power -3 }
sphere { 0, 1
box { 0, 1 }
#if (Missing) box { } #end
plane { y, }
frobnicate { 1 2 { 3 } }
#declare Fine = sphere { 0, 1 };
object { Fine translate Fine }
END

# errors: line:column of each, as told.
errors()
{
    grep -o '^s\.pov:[0-9]*:[0-9]*: error' said |
        sed 's/s.pov:\(.*\): error/\1/' | tr '\n' ' '
}

new_case 'each error is told once'
brume s.pov --check
exits 1
is "$(errors)" '1:18 2:15 2:47 3:35 6:36 8:1 10:12 11:1 13:15 '
says "hint: did you mean 'pigment'?"
says "hint: did you mean 'phong'?"
says "hint: is a '}' missing? 'sphere' began in line 7"
says "'fade_power' is -3, must be at least 0"
says "undeclared identifier 'frobnicate'"

new_case 'a picture stops at the first'
brume s.pov +W8 +H6
exits 1
is "$(errors)" '1:18 '

new_case 'the names of a function end with it'
for body in 'x + ' 'x * * y' 'sum(i, 1, 3, i * ' 'x * <1, 2>'; do
    echo "#declare F = function { $body }
        #debug vstr(3, x * 2, \" \", 0, 1)
        sphere { x, 1 pigment { rgb y } }" >s.pov
    brume s.pov --check
    exits 1
    says '2.0 0.0 0.0'
    is "$(grep -c error: said)" 1
done

new_case 'it writes nothing, and reads what it would have written'
echo 'old' >there.inc
cat >s.pov <<'END'
#fopen F "new.inc" write
#write(F, "#declare A = 5;\n")
#fclose F
#include "new.inc"
#fopen F "new.inc" append
#write(F, "#declare B = 6;\n")
#fclose F
#include "new.inc"
#fopen F "there.inc" write
#write(F, "\"x\", 7")
#fclose F
#fopen F "there.inc" read
#read(F, T, C)
#fclose F
#debug concat(str(A, 0, 0), str(B, 0, 0), T, str(C, 0, 0),
    str(file_exists("new.inc"), 0, 0), "\n")
#fopen F "../far.inc" write
END
brume s.pov --check
exits 4
says '56x71'
says "writing '../far.inc' is not allowed"
is "$(cat there.inc)" old
is "$(find . -name new.inc)" ''

new_case '#error ends it'
printf '#error "enough"\nbox { }\n' >s.pov
brume s.pov --check
exits 1
is "$(errors)" '1:1 '

new_case 'it never goes on for ever'
for text in '}' '{' ')))' '#declare A = {' 'sphere { {' '#macro M(' \
    'sphere { 0, 1 }}}}' 'box' '<' '"a" "b" 3 4' 'union { union { union {'; do
    echo "$text" >s.pov
    brume s.pov --check
    exits 1
done
yes 'wrong { }' | head -n 1000 >s.pov
brume s.pov --check
exits 1
yes 'box { }' | head -n 1000 >s.pov
brume s.pov --check
exits 1
is "$(errors | wc -w)" 100

new_case '--check=json'
printf '#macro M() boxx { 0, 1 } #end\nM()\n#warning "hm"\n' >s.pov
brume s.pov --check=json
exits 1
is "$("$json" printed errors) $("$json" printed warnings)" '1 1'
item() { "$json" printed diagnostics "$@"; }
is "$(item 0 severity) $(item 0 code) $(item 0 line) $(item 0 column)" \
    '"error" 1 1 12'
is "$(item 0 message)" "\"undeclared identifier 'boxx'\""
is "$(item 0 hint)" "\"did you mean 'box'?\""
is "$(item 0 trace 0)" '"s.pov:2: in macro M called here"'
is "$(item 1 severity)" '"warning"'

new_case '--check=json of what is right'
echo 'sphere { 0, 1 }' >s.pov
brume s.pov --check=json
exits 0
is "$("$json" printed errors)" 0
is "$("$json" printed diagnostics)" '[]'

end_cases
