"""Reads translation units with libclang."""
import os
import re
import shlex

from clang import cindex

from mutation.finder import Finder

CORE = "src/core/"
FATAL = cindex.Diagnostic.Fatal


def arguments(command, moved=("", "")):
    """Returns a compiler command's arguments for libclang, with one path instead of another."""
    words = shlex.split(re.sub(r" (-o|-c) \S+", "", command))[1:]
    # Highway would include a kernel once for each instruction set.
    return [word.replace(*moved) if moved[0] else word for word in words] + [
        "-DHWY_COMPILE_ONLY_STATIC"]


def parse(path, options):
    unit = cindex.Index.create().parse(str(path), args=options)
    fatal = [str(each) for each in unit.diagnostics if each.severity >= FATAL]
    if fatal:
        raise RuntimeError("{}: {}".format(path, fatal[0]))
    return unit


def find(tree, files):
    """Returns the finder that visited the units which see the files, and {unit: files it sees}."""
    finder = Finder(tree.root, files)
    real = {os.path.realpath(tree.root / file): file for file in files}
    folders = {os.path.dirname(file) for file in files}
    units = {}
    for name, command in sorted(tree.commands().items()):
        if not name.startswith(CORE) and os.path.dirname(name) not in folders:
            continue
        unit = parse(tree.root / name, arguments(command, (str(tree.sources), str(tree.root))))
        seen = [include.include.name for include in unit.get_includes()] + [unit.spelling]
        seen = {real.get(os.path.realpath(path)) for path in seen} - {None}
        if seen:
            units[name] = seen
            finder.visit_unit(unit)
    return finder, units
