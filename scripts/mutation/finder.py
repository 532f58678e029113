"""Finds everything in a translation unit that can be mutated."""
import re

from clang.cindex import CursorKind as Kind

from mutation import source
from mutation.expressions import Expressions
from mutation.mutant import Mutant

# Compile-time values, or no code at all.
SKIPPED = {
    Kind.STATIC_ASSERT, Kind.ENUM_DECL, Kind.TYPE_ALIAS_DECL, Kind.TYPEDEF_DECL,
    Kind.TYPE_ALIAS_TEMPLATE_DECL, Kind.TEMPLATE_NON_TYPE_PARAMETER, Kind.TEMPLATE_TYPE_PARAMETER,
    Kind.ALIGNED_ATTR, Kind.CXX_UNARY_EXPR, Kind.DECL_REF_EXPR,
}
FUNCTIONS = {Kind.FUNCTION_DECL, Kind.FUNCTION_TEMPLATE, Kind.CXX_METHOD, Kind.CONSTRUCTOR,
             Kind.CONVERSION_FUNCTION}
LOOPS = {Kind.FOR_STMT, Kind.WHILE_STMT, Kind.DO_STMT, Kind.CXX_FOR_RANGE_STMT}
BLOCKS = {Kind.COMPOUND_STMT, Kind.CXX_TRY_STMT, Kind.CXX_CATCH_STMT}
WITH_BODY = (LOOPS - {Kind.DO_STMT}) | {Kind.IF_STMT, Kind.SWITCH_STMT, Kind.CASE_STMT,
                                        Kind.DEFAULT_STMT}


class Finder(Expressions):
    """Declarations and statements."""

    def visit_unit(self, unit):
        for cursor in unit.cursor.get_children():
            if self._file(cursor.location.file):
                self._visit(cursor, unit.cursor, ())

    def _visit(self, cursor, parent, demoted):
        if cursor.kind in SKIPPED or not self._file(cursor.extent.start.file):
            return
        if cursor.kind == Kind.VAR_DECL or cursor.kind in FUNCTIONS:
            demoted += self._constexpr(cursor)
        if cursor.kind.is_expression():
            self._expression(cursor, parent, demoted)
        else:
            self._host_statement(cursor, demoted)
        children = list(cursor.get_children())
        if cursor.kind == Kind.IF_STMT:
            children = self._if(cursor, children, demoted)
        elif cursor.kind in LOOPS:
            self._loop(cursor, children, demoted)
        elif cursor.kind == Kind.COMPOUND_STMT:
            self._block(children, parent, demoted)
        elif cursor.kind == Kind.CONDITIONAL_OPERATOR:
            self._condition(children[0], demoted)
        elif cursor.kind in (Kind.CASE_STMT, Kind.DEFAULT_STMT):
            children = children[-1:]
            self._statement(children[-1], demoted)
        for child in children:
            if not self._is_constant(child, cursor):
                self._visit(child, cursor, demoted)

    def _constexpr(self, cursor):
        """Returns how the declaration of a variable or function is made one for run time."""
        file, start, _ = self._span(cursor)
        text = self.texts[file]
        match = re.search(r"\bconstexpr\b", text[start:cursor.location.offset])
        if not match:
            return ()
        specifiers = text[start:cursor.location.offset]
        inline = "" if re.search(r"\binline\b", specifiers) else "inline"
        if cursor.kind in FUNCTIONS:
            instead = inline
        elif cursor.semantic_parent.kind in (Kind.CLASS_DECL, Kind.STRUCT_DECL):
            instead = inline + " const"
        else:
            instead = "const"
        return ((file, start + match.start(), instead),)

    def _is_constant(self, child, parent):
        """Whether an expression is an array's bound or a template's argument."""
        if not child.kind.is_expression():
            return False
        file, start, end = self._span(child)
        if not file:
            return True
        before = self.texts[file][:start].rstrip()[-1:]
        after = self.texts[file][end:end + 80].lstrip()[:1]
        if parent.kind in (Kind.VAR_DECL, Kind.FIELD_DECL) and before == "[":
            return True
        in_operator = parent.kind in (Kind.BINARY_OPERATOR, Kind.CALL_EXPR) and (
            self._operands(parent) is not None)
        template = any(sibling.kind == Kind.TEMPLATE_REF for sibling in parent.get_children())
        return not in_operator and (
            before == "<" or (template and before == "," and after in (">", ",")))

    # Statements

    def _block(self, statements, parent, demoted):
        for index, statement in enumerate(statements):
            self._statement(statement, demoted)
            goes_on = index + 1 < len(statements) or parent.kind in LOOPS
            if goes_on and statement.kind == Kind.IF_STMT:
                self._early_return(statement, demoted)

    def _early_return(self, statement, demoted):
        parts = list(statement.get_children())
        if self._has_else(parts):
            return
        last = parts[-1]
        while last.kind == Kind.COMPOUND_STMT and list(last.get_children()):
            last = list(last.get_children())[-1]
        if last.kind == Kind.RETURN_STMT:
            self._delete(last, demoted)

    def _statement(self, statement, demoted):
        deletable = statement.kind.is_expression() or statement.kind in (
            Kind.BREAK_STMT, Kind.CONTINUE_STMT)
        if deletable:
            self._delete(statement, demoted)

    def _delete(self, statement, demoted):
        span = self._host_statement(statement, demoted)
        if span:
            self.mutants.add(Mutant(*span, "", True, "", demoted))

    def _host_statement(self, cursor, demoted):
        """Returns (file, start, end) with the semicolon; None for what is no whole statement."""
        if cursor.kind == Kind.DECL_STMT or not (
                cursor.kind.is_statement() or cursor.kind.is_expression()):
            return None
        file, start, _ = self._span(cursor)
        end = self._statement_end(cursor)
        if not file or not end:
            return None
        self.hosts[file, start, end, True] = ("", demoted)
        return file, start, end

    def _statement_end(self, cursor):
        file, _, end = self._span(cursor)
        if cursor.kind in BLOCKS:
            return end
        if cursor.kind in WITH_BODY:
            return self._statement_end(list(cursor.get_children())[-1])
        return source.semicolon_after(self.texts[file], end) if file else None

    def _has_else(self, parts):
        return len(parts) > 2 and self._between(*parts[-2:]).lstrip("; ") == "else"

    def _if(self, cursor, parts, demoted):
        has_else = self._has_else(parts)
        for body in parts[-2:] if has_else else parts[-1:]:
            self._statement(body, demoted)
        condition = parts[-3 if has_else else -2]
        if re.match(r"if\s+constexpr\b", self._text(cursor)):
            parts.remove(condition)
        else:
            self._condition(condition, demoted)
        return parts

    def _loop(self, cursor, parts, demoted):
        if cursor.kind == Kind.DO_STMT:
            self._condition(parts[1], demoted)
            return
        self._statement(parts[-1], demoted)
        if cursor.kind == Kind.WHILE_STMT:
            self._condition(parts[0], demoted)
