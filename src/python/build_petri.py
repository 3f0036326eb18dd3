"""The cffi definition of petri._petri: the declarations of the public headers, and a few C functions.

The environment variable PETRI_HEADERS is the folder of the headers, and PETRI_LIBRARIES contains the linker's
arguments. Without these variables, pkg-config finds installed libraries.
"""

import os
import re
import shlex
import subprocess
from pathlib import Path

import cffi


def pkg_config(option):
    words = subprocess.run(["pkg-config", option, "petri-draw", "petri-archive"], check=True, stdout=subprocess.PIPE, text=True)
    return shlex.split(words.stdout)


def declarations(header):
    """Returns a header without preprocessor directives, C++ parts and inline functions."""
    text = Path(header).read_text(encoding="utf-8")
    text = re.sub(r"#ifdef __cplusplus\n.*?#endif\n", "", text, flags=re.S)
    text = re.sub(r"^static inline .*?^}\n", "", text, flags=re.S | re.M)
    text = re.sub(r"^#(?:[^\n]*\\\n)*[^\n]*\n", "", text, flags=re.M)
    text = re.sub(r"^enum \{\n\};\n", "", text, flags=re.M)  # display lists, whose rows are included
    return re.sub(r"\bPETRI_API\b", "", text)


if "PETRI_HEADERS" in os.environ:
    headers = os.environ["PETRI_HEADERS"]
    compile_args = ["-I" + headers]
    link_args = shlex.split(os.environ["PETRI_LIBRARIES"])
else:
    compile_args = pkg_config("--cflags")
    link_args = pkg_config("--libs")
    headers = subprocess.run(["pkg-config", "--variable=includedir", "petri-draw"], check=True, stdout=subprocess.PIPE,
                             text=True).stdout.strip()

here = Path(__file__).parent
ffi = cffi.FFI()
ffi.cdef("".join(declarations(Path(headers) / name)
                 for name in ("petri.h", "petri-edit.h", "petri-inspect.h", "petri-live.h", "petri-ranks.h",
                              "petri-draw.h", "petri-archive.h")))
helpers = (here / "helpers.h").read_text(encoding="utf-8")
ffi.cdef(re.sub(r"^#.*\n", "", helpers, flags=re.M))
ffi.cdef("""
    extern "Python" void petri_python_diagnostic(void *user_data, const PetriDiagnostic *diagnostic);
    extern "Python" void petri_python_trust(void *user_data, const PetriTrust *trust);
    extern "Python" bool petri_python_write(void *user_data, const char *text, size_t length);
    extern "Python" bool petri_python_force(void *user_data, const PetriSystem *system, double clock, double delta,
                                            double *force);
    extern "Python+C" void petri_python_called(PetriCall *call, void *user_data, const PetriValue *arguments, uint32_t count,
                                               PetriValue *out);
""")
ffi.set_source(
    "petri._petri",
    helpers + (here / "helpers.c").read_text(encoding="utf-8"),
    extra_compile_args=compile_args + ["-std=c17", "-D_XOPEN_SOURCE=700", "-fvisibility=hidden"],
    extra_link_args=link_args,
)

if __name__ == "__main__":
    ffi.compile(verbose=True)
