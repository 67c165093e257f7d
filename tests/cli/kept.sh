#!/bin/sh
# What does not change from frame to frame of a film is read once, and the
# pictures are those of frames that are read alone.
. "$(dirname "$0")/lib"

# grid N: a mesh2's lists, or with a second word a mesh's triangles.
grid()
{
    awk -v n="$1" -v as="$2" '
        function at(i, j) {
            return sprintf("<%.3f,%.3f,%.3f>", 2 * i / n - 1,
                           sin(i * j * 0.3) / 5, 2 * j / n - 1)
        }
        BEGIN {
            if (as == "triangles") {
                for (i = 0; i < n; i++) for (j = 0; j < n; j++)
                    printf "triangle { %s, %s, %s }\n", at(i, j),
                           at(i + 1, j), at(i, j + 1)
                exit
            }
            printf "vertex_vectors { %d\n", (n + 1) * (n + 1)
            for (i = 0; i <= n; i++) for (j = 0; j <= n; j++)
                printf ",%s\n", at(i, j)
            printf "} face_indices { %d\n", n * n
            for (i = 0; i < n; i++) for (j = 0; j < n; j++)
                printf ",<%d,%d,%d>\n", i * (n + 1) + j,
                       (i + 1) * (n + 1) + j, i * (n + 1) + j + 1
            print "}"
        }'
}

cat >head.inc <<'END'
camera { location <0, 2, -3> look_at 0 angle 60 }
light_source { <3, 5, -9> rgb 1 }
background { rgb 0.3 }
#default { finish { ambient 0.2 } }
END

# A mesh2 in the scene, also moved, with lists that depend on the clock; a
# mesh in an include file; a file's mesh; texts in another order each frame.
{
    echo '#include "head.inc"'
    echo '#if (frame_number = 2) #include "late.inc" #end'
    echo '#declare M = mesh2 {'
    grid 33
    cat <<'END'
        #if (clock < 0.1 | (clock > 0.3 & clock < 0.9))
            uv_vectors { 3, <0, 0>, <1, 0>, <0, 1> }
            normal_vectors { 1156 #for (I, 1, 1156) <sin(I), 1, 0> #end }
        #end
        pigment { rgb <1, clock, 0> }
    }
    object { M rotate 60*clock*y translate clock*x }
    object { M scale 0.5 translate y }
    #include "triangles.inc"
    object { T pigment { rgb z + clock*y } rotate 30*z translate -clock*x }
    #include "late.inc"
    mesh { ply "square.ply" pigment { rgb y } translate <0, clock, 1> }
    mesh {
END
    grid 8 triangles
    cat <<'END'
        #if (clock > 0.6) triangle { <-1,0,0>, <0,2,0>, <1,0,0> } #end
        pigment { rgb <1, 0, 1> } translate -0.5*y
    }
END
} >still.pov
{
    echo '#declare T = mesh {'
    grid 10 triangles
    echo '}'
} >triangles.inc
echo '#ifndef (L) #declare L = 1; sphere { clock*y, 0.2 pigment { rgb x } } #end' \
    >late.inc
cat >square.ply <<'END'
ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 2
property list uchar int vertex_indices
end_header
-1 0 -1
1 0 -1
1 0 1
-1 0 1
3 0 1 2
3 0 2 3
END
# A file may change until its time stamp would show it.
sleep 0.2

new_case 'frames of a film, and alone'
film='+W32 +H24 --spp 2 +KFF5 +FE'
brume still.pov $film +Ofilm --stats stats.json
exits 0
for i in 1 2 3 4 5; do
    brume still.pov $film +SF$i +EF$i +Oalone
    exits 0
    same film$i.exr alone$i.exr
    [ $i = 1 ] || ! cmp -s film1.exr film$i.exr || complain "$i is as 1"
done

# counts NAME: of the five frames.
counts()
{
    grep -o "\"$1\": [0-9]*" stats.json | tr -dc '0-9\n' | tr '\n' ' '
}
new_case 'each text and mesh is read once'
is "$(counts texts_read)" '4 0 0 0 0 '
is "$(counts texts_kept)" '0 4 4 4 4 '
# Two of them have more than what is spelt out, for a frame or two.
is "$(counts meshes_read)" '4 1 1 2 1 '
is "$(counts meshes_kept)" '0 3 4 4 4 '

new_case 'and the tree of a large mesh is built once'
is "$(counts trees_built)" '1 0 0 0 0 '
is "$(counts trees_kept)" '1 2 2 2 2 '

new_case 'a file that the scene writes is read anew'
cat >writes.pov <<'END'
#include "head.inc"
#fopen F "now.inc" write
#write (F, "sphere { ", clock, "*x, 0.5 pigment { rgb y } }\n")
#fclose F
#include "now.inc"
END
brume writes.pov $film +Ofilm
for i in 1 3 5; do
    brume writes.pov $film +SF$i +EF$i +Oalone
    same film$i.exr alone$i.exr
done

new_case 'a scene from a stream'
"$BRUME" - $film +Ofilm --stats stats.json <still.pov >printed 2>said
took $?
exits 0
is "$(counts texts_kept)" '0 4 4 4 4 '
"$BRUME" - $film +SF4 +EF4 +Ostream <still.pov >printed 2>said
took $?
exits 0
same film4.exr stream4.exr

new_case 'errors are told where they are'
echo '#if (frame_number = 2) sphere { 0, Oops } #end' >err.inc
cat >where.pov <<'END'
#if (frame_number = 2) #include "late.inc" #end
#include "err.inc"
END
sleep 0.2
brume where.pov $film +Ofilm
exits 1
says 'err.inc:1:36: error'

new_case 'no mesh takes another and triangles'
cat >both.pov <<'END'
#declare M = mesh { triangle { x, y, z } }
object { M }
mesh { M triangle { x, y, z } }
END
brume both.pov --check
exits 1
says 'takes triangles or one mesh'

end_cases
