"""Finds what can be mutated in an expression."""
import re

from clang.cindex import CursorKind as Kind
from clang.cindex import TypeKind

from mutation import operators, source
from mutation.code import Code, canonical, is_class, is_eigen

PLAIN = "dominant_plane_detection_plain"

HOSTS = {Kind.BINARY_OPERATOR, Kind.COMPOUND_ASSIGNMENT_OPERATOR, Kind.UNARY_OPERATOR,
         Kind.CALL_EXPR, Kind.CONDITIONAL_OPERATOR, Kind.PAREN_EXPR, Kind.INTEGER_LITERAL,
         Kind.FLOATING_LITERAL, Kind.CXX_BOOL_LITERAL_EXPR}
LITERALS = {Kind.INTEGER_LITERAL, Kind.FLOATING_LITERAL}
FLOATS = {TypeKind.FLOAT, TypeKind.DOUBLE}
NUMBERS = FLOATS | {TypeKind.INT, TypeKind.UINT, TypeKind.LONG, TypeKind.ULONG, TypeKind.SHORT,
                    TypeKind.USHORT, TypeKind.SCHAR, TypeKind.UCHAR, TypeKind.CHAR_S}


def operand(text):
    """Returns the text on one line, in brackets where it has operators."""
    text = outside = source.flat(text)
    while re.search(r"[(\[<][^()\[\]<>]*[)\]>]", outside):
        outside = re.sub(r"[(\[<][^()\[\]<>]*[)\]>]", "", outside)
    return text if re.fullmatch(r"[\w.:]*(->[\w.:]+)*", outside) else "({})".format(text)


class Expressions(Code):
    """Operators, literals, conditions and calls of Highway."""

    def _condition(self, condition, demoted):
        """A condition and its opposite, except where that of its operator is the same."""
        if not condition.kind.is_expression() or self._text(condition).startswith("!"):
            return
        operands = self._operands(condition)
        if operands and operands[1] in operators.RELATIONS:
            return
        wrap = "" if canonical(condition).kind == TypeKind.BOOL else "static_cast<bool>"
        self._add(condition, demoted, "!({})".format(source.flat(self._text(condition))), wrap)

    def _expression(self, cursor, parent, demoted):
        file, start, end = self._span(cursor)
        text = self._text(cursor)
        declares = parent.kind == Kind.CONSTRUCTOR or (
            parent.kind.is_declaration() and parent.location.offset == start)
        if cursor.kind not in HOSTS or declares or not text or text.startswith("{"):
            return
        wrap = PLAIN if is_eigen(cursor) else ""
        if cursor.kind in LITERALS:
            wrap = self._literal(cursor, parent, text, demoted)
        elif cursor.kind == Kind.CXX_BOOL_LITERAL_EXPR and text in ("true", "false"):
            self._add(cursor, demoted, "false" if text == "true" else "true")
        elif cursor.kind != Kind.PAREN_EXPR:
            operands = self._operands(cursor)
            if operands:
                self._binary(cursor, operands, demoted)
            elif re.match(r"[-!][^-=]", text):
                self._unary(cursor, text, demoted)
            elif cursor.kind == Kind.CALL_EXPR:
                self._vector_call(cursor, text, demoted)
        self.hosts.setdefault((file, start, end, False), (wrap, demoted))

    def _literal(self, cursor, parent, text, demoted):
        own, target = canonical(cursor), canonical(parent)
        converted = parent.kind == Kind.UNEXPOSED_EXPR and target.kind in NUMBERS and (
            target.kind != own.kind and self._span(parent) == self._span(cursor))
        wrap = "static_cast<{}>".format(target.spelling) if converted else ""
        for variant in operators.literal_variants(text, converted and target.kind in FLOATS):
            self._add(cursor, demoted, variant, wrap)
        return wrap

    def _binary(self, cursor, operands, demoted):
        left, sign, right = operands
        others = (operators.RELATIONS.get(sign) or operators.LOGIC.get(sign) or
                  operators.ARITHMETIC.get(sign) or operators.ASSIGNMENTS.get(sign) or ())
        arithmetic = sign in operators.ARITHMETIC or sign in operators.ASSIGNMENTS
        if arithmetic and is_class(cursor) and not is_eigen(cursor):
            return
        for other in others:
            if other in ("/", "/=") and is_class(right):
                continue
            if other in ("+", "+=") and canonical(right).kind == TypeKind.POINTER:
                continue
            wrap = PLAIN if sign in operators.ARITHMETIC and is_eigen(cursor) else ""
            self._add(cursor, demoted, "{} {} {}".format(
                operand(self._text(left)), other, operand(self._text(right))), wrap)

    def _unary(self, cursor, text, demoted):
        wrap = PLAIN if is_eigen(cursor) else ""
        if text[0] == "!":
            wrap = "static_cast<bool>"
        self._add(cursor, demoted, "({})".format(source.flat(text[1:])), wrap)

    def _vector_call(self, cursor, text, demoted):
        match = operators.VECTOR_CALL.match(text)
        if not match:
            return
        name = match.group(1)
        rest = source.flat(text[match.end():])
        for other in operators.VECTOR_FUNCTIONS.get(name, ()):
            self._add(cursor, demoted, "hn::{}({}".format(other, rest))
        if name in operators.VECTOR_IDENTITIES:
            argument = self._text(list(cursor.get_children())[-1])
            self._add(cursor, demoted, "({})".format(source.flat(argument)))
