#!/bin/sh
# Programs that call povray, called for real with brume in its place. PYTHON is
# a Python that has vapory and ase (pip install vapory ase); what it lacks is
# skipped.
. "$(dirname "$0")/../cli/lib"
PYTHON=${PYTHON:-python3}
mkdir bin
ln -s "$BRUME" bin/povray
PATH=$PWD/bin:$PATH
export PATH

# Whether the module is there; the case is skipped if not.
has_module()
{
    "$PYTHON" -c "import $1" 2>/dev/null && return 0
    echo "ok - $2 # SKIP $PYTHON has no $1"
    return 1
}

python()
{
    "$PYTHON" - >printed 2>said
    took $?
}

if has_module vapory 'vapory draws'; then
    new_case 'vapory draws'
    python <<'END'
import vapory as v
camera = v.Camera('location', [0, 2, -3], 'look_at', [0, 1, 2])
scene = v.Scene(camera, [
    v.LightSource([2, 4, -3], 'color', [1, 1, 1]),
    v.Background('color', [0.2, 0.3, 0.5]),
    v.Sphere([0, 1, 2], 2, v.Texture(v.Pigment('color', [1, 0, 1])))])
scene.render('plain.png', width=48, height=36, antialiasing=0.01, quality=9)
scene.render('alpha.png', width=48, height=36, output_alpha=True)
array = scene.render(width=48, height=36)
print(array.shape, array.dtype)
middle, corner = array[18, 24], array[0, 0]
print(middle[0] > 100, middle[1] == 0, corner[2] > corner[0] > 0)
wrong = v.Scene(camera, [v.Sphere([0, 1, 2], 'nonsense')])
try:
    wrong.render('wrong.png', width=8, height=8)
except IOError as error:
    print('told', 'nonsense' in str(error))
END
    exits 0
    has plain.png
    has alpha.png
    prints '(36, 48, 3) uint8'
    prints 'True True True'
    prints 'told True'
fi

if has_module ase 'ase draws'; then
    new_case 'ase draws'
    python <<'END'
import os
from ase.build import molecule
from ase.io import write
from ase.io.pov import get_bondpairs
atoms = molecule('C6H6')
atoms.center(vacuum=1.0)
settings = dict(canvas_width=60, bondatoms=get_bondpairs(atoms, 1.1),
                textures=['ase3'] * len(atoms),
                point_lights=[[(2.0, 3.0, 40.0), 'White']])
picture = write('benzene.pov', atoms, rotation='10x,20y',
                povray_settings=settings).render()
print(os.path.getsize(picture) > 100)
END
    exits 0
    has benzene.png
    prints True
fi

end_cases
