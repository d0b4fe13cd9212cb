#!/usr/bin/env python3
"""Microsoft's DirectX shader compiler as a command, where there is the library but not the program `dxc`.

    dxc -T PROFILE -E ENTRY FILE [OPTIONS]

exits 0 where the library compiles the file, and else prints what it says. DXC_LIBRARY names the library. The interfaces are
those of dxcapi.h, whose objects begin with a table of functions: the three of IUnknown, which outside of Windows are followed
by two destructors, and then their own.
"""

import ctypes
import os
import sys
import uuid

OWN = 5  # functions before those of an interface
CLASS_COMPILER = "73e22d93-e6ce-47f3-b5bf-f0664f39c1b0"
CLASS_LIBRARY = "6245d6af-66e0-48fd-80b4-4d271796748c"
INTERFACE_COMPILER = "8c210bf3-011f-4422-8d70-6f9acb8db617"
INTERFACE_LIBRARY = "e5204dc7-d18c-4c3c-bdfb-851673980fe7"
UTF8 = 65001

Pointer = ctypes.c_void_p


def made(library, of, interface):
    """An object of a class, by one of its interfaces."""
    out = Pointer()
    status = library.DxcCreateInstance(
        uuid.UUID(of).bytes_le, uuid.UUID(interface).bytes_le, ctypes.byref(out)
    )
    if status != 0:
        sys.exit(f"dxc: the library makes no {of}")
    return out


def call(subject, index, result, *arguments):
    """Calls the function at a place of an object's table. Arguments are pairs of type and value."""
    table = ctypes.cast(subject, ctypes.POINTER(ctypes.POINTER(Pointer)))[0]
    types = [ty for ty, _ in arguments]
    function = ctypes.CFUNCTYPE(result, Pointer, *types)(table[OWN + index])
    return function(subject, *(value for _, value in arguments))


def text_of(blob):
    """The bytes of a blob as text."""
    start = call(blob, 0, Pointer)
    size = call(blob, 1, ctypes.c_size_t)
    return ctypes.string_at(start, size).rstrip(b"\0").decode("utf-8", "replace")


def compiled(library, code, entry, profile, options):
    """Whether the code compiles, and what is said of it."""
    u32, out = ctypes.c_uint32, ctypes.POINTER(Pointer)
    blob, result, errors = Pointer(), Pointer(), Pointer()
    helper = made(library, CLASS_LIBRARY, INTERFACE_LIBRARY)
    call(helper, 4, ctypes.c_int32, (ctypes.c_char_p, code), (u32, len(code)), (u32, UTF8), (out, ctypes.byref(blob)))
    compiler = made(library, CLASS_COMPILER, INTERFACE_COMPILER)
    words = (ctypes.c_wchar_p * max(len(options), 1))(*options)
    status = call(
        compiler,
        0,
        ctypes.c_int32,
        (Pointer, blob),
        (ctypes.c_wchar_p, "input.hlsl"),
        (ctypes.c_wchar_p, entry),
        (ctypes.c_wchar_p, profile),
        (Pointer, ctypes.cast(words, Pointer)),
        (u32, len(options)),
        (Pointer, None),
        (u32, 0),
        (Pointer, None),
        (out, ctypes.byref(result)),
    )
    if status == 0:
        answer = ctypes.c_int32()
        call(result, 0, ctypes.c_int32, (ctypes.POINTER(ctypes.c_int32), ctypes.byref(answer)))
        status = answer.value
    said = ""
    if result and call(result, 2, ctypes.c_int32, (out, ctypes.byref(errors))) == 0 and errors:
        said = text_of(errors)
    return status == 0, said


def main():
    profile, entry, path, options = "ps_6_0", "main", None, []
    words = iter(sys.argv[1:])
    for word in words:
        if word == "-T":
            profile = next(words, profile)
        elif word == "-E":
            entry = next(words, entry)
        elif word == "-Fo":
            next(words, None)
        elif word.startswith("-"):
            options.append(word)
        else:
            path = word
    library = ctypes.CDLL(os.environ.get("DXC_LIBRARY", "libdxcompiler.so"))
    with open(path, "rb") as file:
        good, said = compiled(library, file.read(), entry, profile, options)
    sys.stderr.write(said)
    # the library's threads do not always end in order
    sys.stderr.flush()
    os._exit(0 if good else 1)


main()
