"""Values of expressions of the scene language, as POV-Ray computes them."""
import os
import subprocess
import tempfile


def values(expressions, declarations=""):
    """Each expression must give a number; they come back as floats."""
    with tempfile.TemporaryDirectory() as folder:
        source = os.path.join(folder, "values.pov")
        output = os.path.join(folder, "values.txt")
        with open(source, "w") as file:
            file.write("#version 3.7;\n"
                       "global_settings { assumed_gamma 1 }\n"
                       + declarations + f'\n#fopen OUT "{output}" write\n')
            for text in expressions:
                file.write(f'#write(OUT, str({text}, 0, 17), "\\n")\n')
            file.write("#fclose OUT\n")
        done = subprocess.run(
            ["povray", "+I" + source, "-D", "-F", "+W1", "+H1", "-V"],
            capture_output=True, text=True, cwd=folder)
        with open(output) as file:
            found = [float(line) for line in file]
        if len(found) != len(expressions):
            raise RuntimeError(done.stderr)
        return found
