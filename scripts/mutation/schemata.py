"""Writes a file with mutants of it compiled in, to be chosen when a program starts."""
import re

VARIABLE = "DPD_MUTANT"  # the environment's: the number of the mutant that is active, 0 for none

# Included before everything else. What Eigen gives for a + b and for a - b has two types: `plain`
# makes both the same. It has to leave everything else alone, vector registers above all.
HEADER = """#pragma once
#include <cstdlib>
#include <utility>

inline const int dominant_plane_detection_mutant =
    std::getenv("%s") ? std::atoi(std::getenv("%s")) : 0;
#define DPD_MUTANT(number) (dominant_plane_detection_mutant == (number))

template <typename Expression>
auto dominant_plane_detection_plain(const Expression& expression) {
  return typename Expression::PlainObject(expression);
}
""" % (VARIABLE, VARIABLE)


class _Node:
    """Mutants of one stretch of text, and the stretches within it."""

    def __init__(self, start, end):
        self.start, self.end = start, end
        self.mutants = []  # (number, mutant)
        self.instead = None  # for a `constexpr`
        self.children = []


def rewrite(text, numbered, demoted=()):
    """Returns the text of a file with mutants in it, on the same lines.

    `numbered` holds (number, mutant) of this file, `demoted` (offset, text) of each `constexpr` that
    any mutant makes one no more. In the changed text of a mutant there are no others, as only one is
    active at a time; in the original text there are.
    """
    nodes = {}
    for number, mutant in numbered:
        # A statement that is all of another stretch comes outside of it.
        key = (mutant.start, -mutant.end, not mutant.statement)
        nodes.setdefault(key, _Node(mutant.start, mutant.end)).mutants.append((number, mutant))
    for offset, instead in demoted:
        node = _Node(offset, offset + len("constexpr"))
        node.instead = instead
        nodes[offset, -node.end, True] = node
    root = _Node(0, len(text))
    open_nodes = [root]
    for _, node in sorted(nodes.items(), key=lambda item: item[0]):
        while node.start >= open_nodes[-1].end:
            open_nodes.pop()
        if node.end > open_nodes[-1].end:
            raise ValueError("stretches of text overlap at byte {}".format(node.start))
        open_nodes[-1].children.append(node)
        open_nodes.append(node)
    return _inside(text, root)


def numbers_near(line, column):
    """Returns the mutants in a line of rewritten text, nearest before the column (from 1) first."""
    found = [(match.start(), int(match.group(1)))
             for match in re.finditer(r"DPD_MUTANT\((\d+)\)", line)]
    before = [number for position, number in reversed(found) if position < column]
    after = [number for position, number in found if position >= column]
    return before + after


def _inside(text, node):
    parts, position = [], node.start
    for child in node.children:
        parts += [text[position:child.start], _render(text, child)]
        position = child.end
    return "".join(parts) + text[position:node.end]


def _render(text, node):
    if node.instead is not None:
        return node.instead
    original = _inside(text, node)
    if node.mutants[0][1].statement:
        choice = "".join("if (DPD_MUTANT({})) {{ {} }} else ".format(number, mutant.text)
                         for number, mutant in node.mutants)
        return "{{ {}{{ {} }} }}".format(choice, original)
    wrap = next((mutant.wrap for _, mutant in node.mutants if mutant.wrap), "")
    choice = "".join("DPD_MUTANT({}) ? {}({}) : ".format(number, wrap, mutant.text)
                     for number, mutant in node.mutants)
    return "({}{}({}))".format(choice, wrap, original)
