"""Times other programs at formulas that come on the standard input, one a line: name, variables, text of SymPy, text of Slang
(between tabs). Writes lines of: peer, version or "missing", what is timed, name, seconds or a word (between tabs)."""

import ctypes
import glob
import importlib.util
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

PATIENCE = 20


def tell(*words):
    print(*words, sep="\t", flush=True)


def median(values):
    return sorted(values)[len(values) // 2]


def timed(action, most=7):
    times = []
    for _ in range(most):
        start = time.perf_counter()
        action()
        times.append(time.perf_counter() - start)
        if sum(times) > 2:
            break
    return median(times)


class TooLong(Exception):
    pass


class Unsolved(Exception):
    pass


def alarm(*_):
    raise TooLong


def within(peer, what, name, action):
    """Tells the seconds of an action, or why there are none."""
    signal.signal(signal.SIGALRM, alarm)
    signal.alarm(PATIENCE)
    try:
        tell(*peer, what, name, action())
    except TooLong:
        tell(*peer, what, name, f"more than {PATIENCE} s")
    except Unsolved:
        tell(*peer, what, name, "none")
    except Exception as error:  # a peer's own failure is its result
        tell(*peer, what, name, "fails: " + type(error).__name__)
    finally:
        signal.alarm(0)


def sympy_peer(formulas):
    try:
        import sympy
    except ImportError:
        return tell("SymPy", "missing", "", "", "")
    from sympy.core.cache import clear_cache

    peer = ("SymPy", sympy.__version__)

    def derive(names, text):
        clear_cache()
        expression = sympy.sympify(text)
        parts = [expression] + [sympy.diff(expression, v) for v in names.split()]
        return sympy.lambdify(names.split(), parts, "math", cse=True)

    def integrate(names, text):
        clear_cache()
        t = sympy.Symbol("t", real=True)
        real = {v: (sympy.Symbol("o" + v, real=True), sympy.Symbol("d" + v, positive=True)) for v in names.split()}
        ways = {v: o + t * d for v, (o, d) in real.items()}
        found = sympy.integrate(sympy.sympify(text).subs(ways), t)
        if found.has(sympy.Integral):
            raise Unsolved

    def per_point(names, text):
        function = derive(names, text)
        point = [0.3, 0.7, -0.4][: len(names.split())]
        return timed(lambda: [function(*point) for _ in range(1000)]) / 1000

    for name, names, text, _ in formulas:
        within(peer, "gradient, made", name, lambda: timed(lambda: derive(names, text), 3))
        within(peer, "value and gradient, a point", name, lambda: per_point(names, text))
        if len(names.split()) == 3:
            within(peer, "integral on a ray, made", name, lambda: timed(lambda: integrate(names, text), 1))


def mpmath_peer(formulas):
    try:
        import mpmath
    except ImportError:
        return tell("mpmath", "missing", "", "", "")
    peer = ("mpmath", mpmath.__version__)
    mpmath.mp.dps = 30
    words = {k: getattr(mpmath, k) for k in ("sin", "cos", "exp", "sqrt", "log")}

    def per_point(names, text):
        names = names.split()
        function = eval(f"lambda {', '.join(names)}: {text}", words)
        point = [mpmath.mpf(x) for x in ("0.3", "0.7", "-0.4")[: len(names)]]

        def all_parts():
            function(*point)
            for k in range(len(names)):
                mpmath.diff(function, tuple(point), tuple(int(j == k) for j in range(len(names))))

        return timed(all_parts)

    for name, names, text, _ in formulas:
        within(peer, "value and gradient, a point", name, lambda: per_point(names, text))


def slang_text(names, text):
    names = names.split()
    arguments = ", ".join("float " + v for v in names)
    calls = "\n".join(
        f"    var p{k} = diffPair(rows[id.x * {len(names)} + {k}]);" for k in range(len(names))
    )
    passed = ", ".join(f"p{k}" for k in range(len(names)))
    stores = "\n".join(
        f"    results[id.x * {len(names) + 1} + {k}] = p{k}.d;" for k in range(len(names))
    )
    values = ", ".join(f"p{k}.p" for k in range(len(names)))
    return f"""
[Differentiable] float f({arguments}) {{ return {text}; }}
StructuredBuffer<float> rows;
RWStructuredBuffer<float> results;
[shader("compute")] [numthreads(64, 1, 1)]
void compute_main(uint3 id : SV_DispatchThreadID) {{
{calls}
    bwd_diff(f)({passed}, 1.0);
{stores}
    results[id.x * {len(names) + 1} + {len(names)}] = f({values});
}}
"""


def slang_library():
    """The compiler in the package slangpy, by its C interface."""
    found = importlib.util.find_spec("slangpy")
    folder = os.path.dirname(found.origin) if found and found.origin else ""
    names = glob.glob(os.path.join(folder, "libslang-compiler.so*")) if folder else []
    if not names:
        return None
    library = ctypes.CDLL(names[0])
    pointer = ctypes.c_void_p
    library.spCreateSession.restype = pointer
    library.spCreateCompileRequest.restype = pointer
    library.spCreateCompileRequest.argtypes = [pointer]
    library.spDestroyCompileRequest.argtypes = [pointer]
    library.spSetCodeGenTarget.argtypes = [pointer, ctypes.c_int]
    library.spAddTranslationUnit.argtypes = [pointer, ctypes.c_int, ctypes.c_char_p]
    library.spAddTranslationUnitSourceString.argtypes = [pointer, ctypes.c_int, ctypes.c_char_p, ctypes.c_char_p]
    library.spAddEntryPoint.argtypes = [pointer, ctypes.c_int, ctypes.c_char_p, ctypes.c_int]
    library.spCompile.argtypes = [pointer]
    library.spGetDiagnosticOutput.restype = ctypes.c_char_p
    library.spGetDiagnosticOutput.argtypes = [pointer]
    library.spGetBuildTagString.restype = ctypes.c_char_p
    session = library.spCreateSession(None)
    spirv, language, compute = 6, 1, 6

    def compile(text):
        request = library.spCreateCompileRequest(session)
        library.spSetCodeGenTarget(request, spirv)
        unit = library.spAddTranslationUnit(request, language, b"unit")
        library.spAddTranslationUnitSourceString(request, unit, b"unit.slang", text.encode())
        library.spAddEntryPoint(request, unit, b"compute_main", compute)
        failed = library.spCompile(request) < 0
        output = library.spGetDiagnosticOutput(request)
        library.spDestroyCompileRequest(request)
        if failed:
            raise ValueError(output.decode()[:200] if output else "")

    return library.spGetBuildTagString().decode(), compile


def slang_program():
    """The command slangc."""
    if not shutil.which("slangc"):
        return None
    version = subprocess.run(["slangc", "-v"], capture_output=True, text=True)

    def compile(text):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "unit.slang")
            with open(path, "w") as file:
                file.write(text)
            command = ["slangc", path, "-target", "spirv", "-entry", "compute_main", "-stage", "compute"]
            subprocess.run(command + ["-o", path + ".spv"], check=True, capture_output=True)

    return (version.stdout + version.stderr).strip(), compile


def slang_peer(formulas):
    found = slang_library() or slang_program()
    if not found:
        return tell("Slang", "missing", "", "", "")
    version, compile = found
    for name, names, _, text in formulas:
        within(("Slang", version), "text to SPIR-V", name, lambda: timed(lambda: compile(slang_text(names, text)), 5))


formulas = [line.rstrip("\n").split("\t") for line in sys.stdin if line.strip()]
sympy_peer(formulas)
mpmath_peer(formulas)
slang_peer(formulas)
