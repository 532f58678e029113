"""Draws mutants at random."""
import random

from mutation import source


class Draw:
    """An endless draw without repetition, the same for the same seed and sources.

    Each time: one of the lines that have mutants left, evenly; one of the stretches of text
    (expressions and statements) that begin there, evenly; one of its mutants, evenly.
    """

    def __init__(self, mutants, texts, seed):
        self._random = random.Random(seed)
        self._lines = {}
        for mutant in sorted(mutants):
            line = mutant.file, source.line_of(texts[mutant.file], mutant.start)
            stretch = mutant.start, mutant.end, mutant.statement
            self._lines.setdefault(line, {}).setdefault(stretch, []).append(mutant)

    def next(self):
        """Returns a mutant, None when all are drawn."""
        if not self._lines:
            return None
        line = self._random.choice(list(self._lines))
        stretches = self._lines[line]
        stretch = self._random.choice(list(stretches))
        mutant = stretches[stretch].pop(self._random.randrange(len(stretches[stretch])))
        if not stretches[stretch]:
            del stretches[stretch]
        if not stretches:
            del self._lines[line]
        return mutant
