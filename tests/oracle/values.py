"""What scenes write and what expressions come to, by POV-Ray."""
import os
import subprocess
import sys
import tempfile


def written(scene, *switches, files=()):
    """The text that `scene` writes into the file "written"; it finds `files`,
    a dictionary of bytes, beside itself."""
    with tempfile.TemporaryDirectory() as folder:
        for name, data in dict(files, **{"a.pov": scene.encode()}).items():
            with open(os.path.join(folder, name), "wb") as file:
                file.write(data)
        done = subprocess.run(
            ["povray", "a.pov", "-D", "-F", "-V", "+W4", "+H4", *switches],
            cwd=folder, capture_output=True, text=True)
        if done.returncode:
            sys.exit(done.stderr[-500:])
        with open(os.path.join(folder, "written")) as file:
            return file.read()


def values(expressions, declarations=""):
    """Each expression must give a number; they come back as floats."""
    found = written(
        "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n" + declarations
        + '\n#fopen OUT "written" write\n'
        + "".join(f'#write(OUT, str({text}, 0, 17), "\\n")\n'
                  for text in expressions)
        + "#fclose OUT\n").split()
    if len(found) != len(expressions):
        sys.exit(f"{len(expressions)} expressions, {len(found)} values")
    return [float(value) for value in found]
