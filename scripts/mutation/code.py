"""The source texts with the cursors of libclang, and what was found in them."""
import os
import re

from clang.cindex import TypeKind

from mutation import source
from mutation.mutant import Mutant


def canonical(cursor):
    return cursor.type.get_canonical()


def is_eigen(cursor):
    return re.match(r"(const )?Eigen::", canonical(cursor).spelling) is not None


def is_class(cursor):
    return canonical(cursor).kind == TypeKind.RECORD


class Code:
    """Collects mutants, and hosts: what a hand-written mutant may replace."""

    def __init__(self, root, files):
        self.texts = {file: source.read(os.path.join(root, file)) for file in files}
        self.mutants = set()
        self.hosts = {}  # (file, start, end, statement) -> (wrap, demoted)
        self._paths = {os.path.realpath(os.path.join(root, file)): file for file in files}
        self._known = {}

    def _file(self, location):
        if location is None:
            return None
        if location.name not in self._known:
            self._known[location.name] = self._paths.get(os.path.realpath(location.name))
        return self._known[location.name]

    def _span(self, cursor):
        extent = cursor.extent
        return self._file(extent.start.file), extent.start.offset, extent.end.offset

    def _text(self, cursor):
        file, start, end = self._span(cursor)
        return self.texts[file][start:end] if file else ""

    def _between(self, left, right):
        """Returns the text between two cursors."""
        file, _, start = self._span(left)
        _, end, _ = self._span(right)
        return source.flat(self.texts[file][start:end]) if file else ""

    def _operands(self, cursor):
        """Returns (left, operator, right) of a binary operator, built in or a function."""
        file, start, end = self._span(cursor)
        left = right = None
        for child in cursor.get_children():
            _, child_start, child_end = self._span(child)
            if (child_start, child_end) == (start, end):
                return None
            if child_start == start:
                left = left or child
            if child_end == end:
                right = child
        if not left or not right or left == right:
            return None
        return left, self._between(left, right), right

    def _add(self, cursor, demoted, text, wrap=""):
        file, start, end = self._span(cursor)
        self.mutants.add(Mutant(file, start, end, text, False, wrap, demoted))
