#!/usr/bin/env python3
"""The standard include files of Brume against POV-Ray's, both in POV-Ray.

Compared are the declared names with their kinds and parameters, the values of
constants, what macros and functions give, and which points lie inside of the
solids. Every name of Brume's files is also used once, and files are included
twice; neither may warn. Needs povray with its include files.

    tests/oracle/includes.py [FOLDER OF POV-RAY'S FILES]
"""
import os
import re
import subprocess
import sys
import tempfile

OWN = os.path.join(os.path.dirname(os.path.abspath(__file__)),
                   "../../scenes/include")
THEIRS = "/usr/share/povray-3.7/include"

# Helpers of POV-Ray's files that its manual does not name.
PRIVATE = set("""
    ARRAYS_HybridQuickSortStep ARRAYS_InsertionSort ARRAYS_QuickSortSeed
    ARRAYS_Temp ARRAYS_Temp_WriteDF3 HFCreate_ FindPoint FromU FromV ToU ToV
    Surface VertexVectors NormalVectors UVVectors NumFaces FaceIndices Build
    EPS EPSNorm __FU __FV __TU __TV __Fx __Fy __Fz VecArr NormArr PArr Ior Disp
    Array Min Max OPt ONorm J K cVal g1 g2 g3 g4 View_POV_Include_Stack
""".split())
SOLIDS = set("""sphere box quadric quartic poly cone cylinder plane object
    union intersection merge""".split())
# How a name of each kind is used in a scene.
USES = {
    "texture": "sphere {{ 0, 1 texture {{ {0} }} }}",
    "pigment": "sphere {{ 0, 1 pigment {{ {0} }} }}",
    "finish": "sphere {{ 0, 1 pigment {{ rgb 1 }} finish {{ {0} }} }}",
    "material": "sphere {{ 0, 1 material {{ {0} }} }}",
    "interior": "sphere {{ 0, 1 pigment {{ rgb 1 }} interior {{ {0} }} }}",
    "color_map": "sphere {{ 0, 1 pigment {{ wood color_map {{ {0} }} }} }}",
    "sky_sphere": "#declare U = sky_sphere {{ {0} }}",
    "camera": "#declare U = camera {{ {0} }}",
    "transform": "sphere {{ 0, 1 pigment {{ rgb 1 }} transform {{ {0} }} }}",
    "seed": "#declare U = rand({0});",
    "solid": "object {{ {0} pigment {{ rgb 1 }} }}",
}
# Results of macros and functions: file, then expressions by type.
CASES = {
    "strings.inc": [("S", e) for e in """
        CRGBStr(rgb <0.1, 0.2, 0.3>, 0, 3);
        CRGBFTStr(rgbft <0.1, 0.2, 0.3, 0.4, 0.5>, 8, 2); Str(1.23456789);
        VStr(<1, 2.5, 3>); VStr2D(<1, 2.5>); Vstr(<1, 2.5, 3>, 6, 2);
        Vstr2D(<1, 2.5>, 6, 2);
        substr(Triangle_Str(<1, 2.5, 3>, <4, 5, 6>, <7, 8, 9>), 40, 40);
        substr(Smooth_Triangle_Str(<1, 2, 3>, x, <4, 5, 6>, y, <7, 8, 9>, z),
               1, 60);
        substr(Smooth_Triangle_Str(<1, 2, 3>, x, <4, 5, 6>, y, <7, 8, 9>, z),
               61, 60)""".split(";")] + [("N", 'Parse_String("1 + 2*3")')],
    "math.inc": [("N", e) for e in """
        sind(30); cosd(40); tand(50); asind(0.3); acosd(0.4); atand(2);
        atan2d(1, -2); max3(1, 5, 3); min3(4, 2, 3); even(3); even(2.5);
        even(-2); odd(-3); odd(2.5); f_sqr(-3); sgn(0); sgn(-2); sgn(2);
        clip(3.7, 1, 2); clip(-1, 1, 2); clip(1.5, 1, 2); clamp(3.7, 1, 2);
        clamp(-3.7, 1, 2); clamp(2, 1, 2); clamp(1, 1, 2); adj_range(0.3, 2, 5);
        adj_range2(3, 2, 5, -1, 4); Interpolate(0.3, 0, 2, 1, 5, -1);
        Interpolate(0.3, 0, 2, 1, 5, -2); Interpolate(0.3, 0, 2, 1, 5, 3);
        Interpolate(0.3, 0, 2, 1, 5, 0); Interpolate(0.3, -1, 2, 1, 5, 1);
        Mean(Numbers); Std_Dev(Numbers, 3.5); VEq(<1, 2, 3>, <1, 2, 3>);
        VEq(<1, 2, 3>, <1, 2, 4>); VZero(<0, 0, 0>); VZero(x);
        VEq5D(<1, 2, 3, 4, 5>, <1, 2, 3, 4, 6>); VZero5D(<0, 0, 0, 0, 1>);
        VLength5D(<1, 2, 3, 4, 5>); VDot5D(<1, 2, 3, 4, 5>, <5, 4, 3, 2, 1>);
        VCos_Angle(<1, 2, 3>, <3, -1, 2>); VAngle(<1, 2, 3>, <3, -1, 2>);
        VAngleD(<1, 2, 3>, <3, -1, 2>); VRotation(x, <1, 1, 0>, z);
        VRotation(x, <1, 1, 0>, -z); VRotationD(x, <-1, 1, 0>, z);
        VRotationD(x, <-1, 1, 0>, <0, 0, 0>); VDist(<1, 2, 3>, <4, 6, 8>);
        VMin(<3, 1, 2>); VMax(<3, 1, 2>);
        Divergence(Fn_A, Fn_B, Fn_C, <0.3, 0.5, 0.7>);
        Gradient_Length(Fn_A, <0.3, 0.5, 0.7>);
        Gradient_Directional(Fn_A, <0.3, 0.5, 0.7>, <1, 2, 3>)
        """.split(";")] + [("V", e) for e in """
        VSqr(<1, 2, 3>); VPow(<1, 2, 3>, 1.5); VPerp_To_Vector(<1, 2, 3>);
        VPerp_To_Vector(<3, 2, 1>); VPerp_To_Vector(<2, 1, 3>);
        VPerp_To_Vector(x); VPerp_To_Vector(y); VPerp_To_Vector(z);
        VPerp_To_Plane(<1, 2, 3>, <3, -1, 2>);
        VPerp_Adjust(<1, 2, 3>, <3, -1, 2>);
        VProject_Plane(<1, 2, 3>, <3, -1, 2>);
        VProject_Axis(<1, 2, 3>, <3, -1, 2>); VWith_Len(<1, 2, 3>, 7);
        vGradient(Fn_A, <0.3, 0.5, 0.7>);
        vCurl(Fn_A, Fn_B, Fn_C, <0.3, 0.5, 0.7>)""".split(";")],
    "transforms.inc": [("T", e) for e in """
        Shear_Trans(<1, 2, 3>, <0, 1, 4>, <2, -1, 1>);
        Matrix_Trans(<1, 2, 3>, <0, 1, 4>, <2, -1, 1>, <5, 6, 7>);
        Axial_Scale_Trans(<1, 2, 3>, 2.5); Axis_Rotate_Trans(<1, 2, 3>, 25);
        Rotate_Around_Trans(<10, 20, 30>, <1, 2, 3>);
        Reorient_Trans(<1, 2, 3>, <-1, 0.5, 0.2>); Reorient_Trans(x, -x);
        Reorient_Trans(<1, 2, 3>, <-2, -4, -6>); Reorient_Trans(y, 2*y);
        Point_At_Trans(<1, 2, 3>); Point_At_Trans(-y); Point_At_Trans(x);
        Center_Trans(Solid, x + z); Align_Trans(Solid, <1, -1, 0>, <3, 4, 5>);
        Spline_Trans(Way, 0.5, y, 0.1, 0); Spline_Trans(Way, 0.5, y, 0.1, 0.5);
        Spline_Trans(Way, 1.5, y, 0.3, 1)""".split(";")] + [
        ("V", "vtransform(<1, 2, 3>, transform { rotate 30*y scale 2 })"),
        ("V", "vinv_transform(<1, 2, 3>, transform { rotate 30*y scale 2 })")],
    "sunpos.inc": [("V", e) for e in """
        SunPos(2000, 6, 21, 12, 2, 0, 51.4667, 0)/1e9; <Al, Az, 0>;
        SunPos(2010, 2, 3, 9, 30, 15, 40, 16)/1e9; <Al, Az, 0>;
        SunPos(1999, 12, 31, 17, 15, -75, -33, -70)/1e9; SolarPosition/1e9
        """.split(";")],
    "functions.inc": [("N", e) for e in """
        f_sphere(1, 2, 3, 1); f_torus(0.4, 0.2, 0.1, 1, 0.3);
        f_snoise3d(0.1, 0.2, 0.3); f_noise3d(0.1, 0.2, 0.3);
        f_noise_generator(0.1, 0.2, 0.3, 1); f_sine_wave(0.4, 1.5, 3);
        f_scallop_wave(0.4, 1.5, 3)""".split(";")] + [
        ("C", "eval_pigment(Paint, <0.1, 0.2, 0.3>)")] + [
        ("C", "f_hexagon(%g, 0, %g)" % (0.9*i, 0.7*i)) for i in range(6)] + [
        ("N", "f_%s(0.31, 0.47, 0.83)" % name) for name in """agate boxed bozo
        brick bumps checker crackle cylindrical dents gradientX gradientY
        gradientZ granite leopard mandel marble onion planar radial
        ripples spherical spiral1 spiral2 spotted waves wood wrinkles""".split()
    ],
    "colors.inc": [("C", e) for e in """
        CHSL2RGB(<200, 0.6, 0.3, 0.1, 0.2>); CHSL2RGB(<-30, 0.6, 0.8, 0, 0>);
        CRGB2HSL(<0.2, 0.5, 0.4, 0.1, 0.2>); CHSV2RGB(<200, 0.6, 0.3, 0, 0>);
        CRGB2HSV(<0.2, 0.5, 0.4, 0.1, 0.2>); CRGB2HSV(<0.3, 0.3, 0.3, 0, 0>)
        """.split(";")],
    "rand.inc": [("R", e) for e in """
        Prob(0.5, Rs); Rand_Cauchy(1, 2, Rs); Rand_Normal(1, 2, Rs);
        Rand_Gauss(1, 2, Rs); Rand_Gauss(1, 2, Rs); Rand_Triangle(1, 4, 2, Rs);
        Rand_Erlang(2, 3, Rs); Rand_Exp(2, Rs); Rand_Lognormal(0.2, 0.5, Rs);
        Rand_Gauss(1, 2, Rs); Rand_Pareto(2, Rs); Rand_Weibull(2, 3, Rs);
        Rand_Bernoulli(0.5, Rs); Rand_Binomial(9, 0.3, Rs); Rand_Geo(0.2, Rs);
        Rand_Poisson(4, Rs); SRand(Rs); RRand(2, 5, Rs)""".split(";")] + [
        ("W", e) for e in """
        VRand(Rs); VRand_In_Box(<1, 2, 3>, <4, 6, 8>, Rs); VRand_In_Sphere(Rs);
        VRand_On_Sphere(Rs); VRand_In_Obj(Solid, Rs)""".split(";")] + [
        ("N", "rand(Rdm%s)" % s) for s in "ABCD"],
    "arrays.inc": [("X", e) for e in """
        Reverse_Array(Numbers); Sort_Partial_Array(Numbers, 1, 4);
        Sort_Array(Numbers); Resize_Array(Numbers, 4)""".split(";")] + [
        ("P", "Rand_Array_Item(Numbers, Rs)")],
    "ior.inc": [("N", "FnPovDispersion(1.5, 0.02)")],
}
SHAPES = [e.strip() for e in """
    Wedge(45); Wedge(135); Wedge(180); Wedge(250);
    Spheroid(<1, 1, 0>, <1, 0.5, 2>);
    Connect_Spheres(<0, 0, 0>, 1, <1, 2, 1>, 0.5);
    Wire_Box(<-1, -1, -1>, <1, 2, 1>, 0.2, 0);
    Round_Box(<-1, -1, -1>, <1, 2, 1>, 0.2, 1);
    Round_Cylinder(<-1, -1, 0>, <1, 2, 1>, 1, 0.2, 0);
    Round_Cone(<-1, -1, 0>, 1, <1, 2, 1>, 0.5, 0.2, 1);
    Round_Cone2(<-1, -1, 0>, 1, <1, 2, 1>, 0.5, 0);
    Round_Cone3(<-1, -1, 0>, 1, <1, 2, 1>, 0.5, 0);
    Supercone(<0, -1.5, 0>, 1, 1.5, <1, 1.5, 0.5>, 1, 0.4);
    Supertorus(1, 0.3, 0.5, 0.3, 0.001, 2);
    Segment_of_Torus(1, 0.3, 120); Segment_of_Torus(1, 0.3, -250);
    Segment_of_CylinderRing(1.5, 0.5, 1, 60); Column_N(5, 1, 2);
    Column_N_AB(5, <-1, -1, 0>, <1, 1, 1>, 0.7); Pyramid_N(6, 1.5, 0.5, 2);
    Pyramid_N_AB(5, <-1, -1, 0>, 1, <1, 1, 1>, 0.4); Egg_Shape(1.15, 1.55);
    Facetted_Sphere(3, 6); Facetted_Egg_Shape(3, 7, 1.2, 1.5);
    Facetted_Egg(4, 10); Ring_Sphere(1.2, 1.3, 0.1, 0.08, 5, 6);
    Round_Pyramid_N_in(5, <0, -1, 0>, 1, <0, 1, 0>, 0.5, 0.15, 1, 0);
    Round_Pyramid_N_out(5, <-1, -1, 0>, 1, <1, 1, 1>, 0.5, 0.15, 0, 1);
    Rounded_Tube(1.5, 1, 0.2, 1, 0);
    Rounded_Tube_AB(<-1, -1, 0>, <1, 1, 1>, 1.5, 1, 0.2, 1);
    Round_Cylinder_Tube(<-1, -1, 0>, <1, 1, 1>, 1, 0.2, 0, 0);
    Round_Conic_Torus(1.5, 0.5, 1, 0.2, 0);
    Round_Conic_Prism(1.5, 0.5, 1, 1.3, 0.2, 0);
    Half_Hollowed_Rounded_Cylinder2(4, 1.5, 0.4, 0.2, 1.5, 0);
    Round_N_Tube_Polygon(5, 0.15, 1.2, 0.4, 0, 0);
    Round_N_Tube_Polygon(4, 0.15, 1.2, 0.3, 1, 0)""".split(";")]
HEAD = """#version 3.7;
global_settings { assumed_gamma 1 }
#declare Numbers = array[6] { 3, 1, 2, 6, 5, 4 }
#declare Solid = sphere { <1, 2, 3>, 2 }
#declare Way = spline {
    cubic_spline -1, <0, 0, 0>, 0, <1, 0, 0>, 1, <2, 1, 1>, 2, <2, 2, 3>,
    3, <1, 3, 5>
}
#declare Paint = pigment { bozo color_map { [0 rgb x] [1 rgbt <0, 1, 1, 1>] } }
#declare Fn_A = function(x, y, z) { x*x*y + z }
#declare Fn_B = function(x, y, z) { y*z - x }
#declare Fn_C = function(x, y, z) { z*z*x + y }
#macro Show_S(S) #debug concat("@", S, "\\n") #end
#macro Show_N(A) Show_S(str(A, 0, 9)) #end
#macro Show_V(A) Show_S(vstr(3, A, ",", 0, 9)) #end
#macro Show_C(A) Show_S(vstr(5, <0, 0, 0, 0, 0> + A, ",", 0, 9)) #end
#macro Show_T(Move)
    #local Moved = function { Move }
    #local P = Moved(1, 0, 0); Show_V(P)
    #local P = Moved(0, 1, 0); Show_V(P)
    #local P = Moved(0, 0, 1); Show_V(P)
    #local P = Moved(0, 0, 0); Show_V(P)
#end
#macro Show_Inside(Object)
    #local Stream = seed(5);
    #for (J, 1, 30)
        #debug "@"
        #for (I, 1, 70)
            #local P = 4.6*(<rand(Stream), rand(Stream), rand(Stream)> - 0.5);
            #debug chr(46 - 11*inside(Object, P))
        #end
        #debug "\\n"
    #end
#end
"""


def run(text, folder):
    """What a scene prints after @, and its warnings and errors."""
    with tempfile.TemporaryDirectory() as d:
        with open(d + "/s.pov", "w") as f:
            f.write(text)
        with open(d + "/povray.ini", "w") as f:
            f.write(f'Library_Path="{folder}"\n')
        p = subprocess.run(
            ["povray", "+Is.pov", "-D", "+W4", "+H4", "-F", "+WT1"], cwd=d,
            capture_output=True, text=True, errors="replace", check=False)
    # Lines longer than a terminal's go on after a blank.
    lines = re.sub(r"\n ", "\n&", p.stderr).replace("\n&", " ").split("\n")
    bad = [s for s in lines if re.search("Parse (Error|Warning)", s)
           and not re.search("No objects|experimental", s)]
    return [s[1:] for s in lines if s.startswith("@")], bad


def stripped(text):
    """Without comments, which nest; strings stay."""
    out, depth, at = [], 0, 0
    token = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*|\*/|.', re.S)
    while at < len(text):
        t = token.match(text, at).group()
        if depth and t not in ("/*", "*/"):
            t = text[at]
        at += len(t)
        depth += (t == "/*") - (t == "*/" and depth > 0)
        if not depth and not t.startswith("//") and t != "*/":
            out.append(t)
    return "".join(out)


def declared(path):
    """name -> ("macro", parameters) or (kind, None) of a file."""
    with open(path, encoding="latin1") as f:
        text = stripped(f.read())
    found = {}
    for m in re.finditer(r"#\s*macro\s+(\w+)\s*\(([^)]*)\)", text):
        found[m[1]] = ("macro", len(re.findall(r"\w+", m[2])))
    for m in re.finditer(
            r'#\s*declare\s+(?:deprecated\s+(?:once\s+)?(?:"[^"]*"\s*)?)?'
            r"(\w+)\s*=\s*(\w+|.)(?:\s*\{\s*internal\s*\((\d+)\))?", text):
        if m[1] not in found:
            kind = m[2].replace("colour", "color")
            found[m[1]] = (kind, m[3])
    return found


def compare_names(theirs, own):
    """Names and macros that differ."""
    wrong = []
    for name, (kind, detail) in theirs.items():
        if name in PRIVATE or re.search("_inc_temp|_MCR", name, re.I):
            continue
        if name not in own:
            wrong.append(f"{name} ({kind}) is missing")
        elif "macro" in (kind, own[name][0]) and own[name] != (kind, detail):
            wrong.append(f"{name}: {kind} {detail}, not {own[name]}")
        elif detail and own[name][1] != detail:
            wrong.append(f"{name}: internal({detail}), not {own[name][1]}")
    return wrong


def kind_of(kind, known):
    """Of a declaration: its use, or None where a value is declared."""
    if kind in SOLIDS:
        return "solid"
    if kind in USES:
        return kind
    if kind in known:
        return kind_of(known[kind][0], {})
    return None


def values(names):
    """Statements that print the numbers, vectors and colours."""
    skip = {"macro", "function", "array", "spline", "mesh2", "version"}
    return "".join(
        f'#ifdef ({n}) Show_S("{n}") Show_C({n}) #end\n'
        for n, (k, _) in sorted(names.items())
        if k not in skip and not kind_of(k, names) and n not in PRIVATE
        and not re.search("inc_temp", n, re.I))


def close(a, b):
    """Whether two printed lines agree, numbers to a millionth."""
    number = r"-?\d+\.\d+"
    if re.sub(number, "", a) != re.sub(number, "", b):
        return False
    return all(abs(float(p) - float(q)) <= 1e-6*(1 + abs(float(p)))
               for p, q in zip(re.findall(number, a), re.findall(number, b)))


def compare_output(text, theirs, own):
    """Lines of a scene that differ, in a few words."""
    a, bad_a = run(text, theirs)
    b, bad_b = run(text, own)
    wrong = [f"{p} | {q}" for p, q in zip(a, b) if not close(p, q)]
    if len(a) != len(b):
        wrong.append(f"{len(a)} | {len(b)} lines; {bad_a[:1]} {bad_b[:1]}")
    return len(a), wrong


def case(kind, expression):
    """A statement that prints a result; the stream is the same for each."""
    e = expression.strip()
    if kind == "R":
        return (f"#declare Rs = seed(7); #declare A = {e}; Show_N(A)"
                " #declare A = rand(Rs); Show_N(A)\n")
    if kind == "W":
        return (f"#declare Rs = seed(7); #declare A = {e}; Show_V(A)"
                " #declare A = rand(Rs); Show_N(A)\n")
    if kind == "P":
        return ("#declare Rs = seed(7);"
                f' #debug concat("@", str({e}, 0, 9), "\\n")\n')
    if kind == "X":
        return (f"{e} #for (I, 0, dimension_size(Numbers, 1) - 1)"
                " Show_N(Numbers[I]) #end\n")
    if kind == "S":
        return f"Show_S({e})\n"
    if kind == "T":
        return f"Show_T(transform {{ {e} }})\n"
    return f"#declare A = {e}; Show_{kind}(A)\n"


def uses(names):
    """Statements that use each name that is not a number or a macro."""
    out = ""
    for name, (kind, _) in names.items():
        use = kind_of(kind, names)
        if use:
            out += USES[use].format(name) + "\n"
    return out


def check_file(name, theirs, report):
    """All comparisons of one file."""
    own = declared(f"{OWN}/{name}")
    head = HEAD + f'#include "{name}"\n'
    given = declared(f"{theirs}/{name}")
    report(name, "names", len(given), compare_names(given, own))
    if name in ("skies.inc", "shapes2.inc", "shapesq.inc", "textures.inc"):
        head = head.replace("#include", '#include "colors.inc"\n'
                            '#include "shapes_old.inc"\n#include', 1)
    text = head + values(given)
    text += "".join(case(k, e) for k, e in CASES.get(name, []))
    report(name, "values", *compare_output(text, theirs, OWN))
    _, bad = run(head + f'#include "{name}"\n' + uses(own), OWN)
    bad = [s for s in bad if "camera" not in s]
    report(name, "use", len(own), bad)


def check_shapes(theirs, report):
    """Points inside of the solids that macros and files make."""
    head = HEAD + '#include "shapes.inc"\n#include "shapes3.inc"\n'
    for shape in SHAPES:
        text = f"{head}#declare O = object {{ {shape} }} Show_Inside(O)\n"
        report("shapes", shape, *compare_output(text, theirs, OWN))
    for name in ("shapes_old.inc", "shapes2.inc", "shapesq.inc"):
        for solid, (kind, _) in declared(f"{theirs}/{name}").items():
            if kind in SOLIDS and not solid.startswith(("Square", "Pyramid")):
                text = (HEAD + '#include "shapes_old.inc"\n'
                        f'#include "{name}"\nShow_Inside({solid})\n')
                report(name, solid, *compare_output(text, theirs, OWN))


def main():
    theirs = sys.argv[1] if len(sys.argv) > 1 else THEIRS
    failures = 0

    def report(name, what, count, wrong):
        nonlocal failures
        failures += bool(wrong)
        print(f"{'DIFFERS' if wrong else 'same':8}{name:16}{what} ({count})")
        for line in wrong[:8]:
            print("        ", line[:150])

    for name in sorted(os.listdir(theirs)):
        if not name.endswith((".inc", ".map")):
            continue
        if os.path.exists(f"{OWN}/{name}"):
            check_file(name, theirs, report)
        else:
            report(name, "file", 0, ["is missing"])
    check_shapes(theirs, report)
    print(failures, "comparisons differ")
    return failures > 0


if __name__ == "__main__":
    sys.exit(main())
