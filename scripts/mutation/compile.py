"""Compiles mutants in, without those that do not compile."""
import concurrent.futures

from mutation import schemata
from mutation.build_tree import BuildError


class Compilation:
    """All mutants together; the numbers of those that had to be left out are in `invalid`."""

    def __init__(self, tree, texts, units, jobs):
        self._tree, self._texts, self._jobs = tree, texts, jobs
        self._units = units  # {file: command} of the units that see the mutated files
        self._commands = tree.commands()
        self._active = {}    # number -> mutant
        self._written = {}
        self.invalid = set()

    def add(self, numbered):
        """Takes more mutants; returns the numbers of those that turned out invalid."""
        before = set(self.invalid)
        self._active.update(numbered)
        pending = self._write()
        while pending:
            with concurrent.futures.ThreadPoolExecutor(self._jobs) as pool:
                results = dict(zip(pending, pool.map(self._check, pending)))
            failed = [unit for unit in pending if results[unit]]
            if failed:
                self._drop([results[unit] for unit in failed])
                again = self._write()
                pending = [unit for unit in self._units if unit in failed or unit in again]
            else:
                pending = []
        return self.invalid - before

    def make(self, targets):
        """Builds; returns the numbers of the mutants that only the tests did not compile with."""
        before = set(self.invalid)
        while True:
            errors = self._tree.make(targets, self._jobs)
            if not errors:
                return self.invalid - before
            self._drop([errors])
            self._write()

    def _check(self, unit):
        return self._tree.check(unit, self._commands[unit])

    def _write(self):
        """Writes the copy; returns the units that have to be compiled again."""
        demoted = {place for mutant in self._active.values() for place in mutant.demoted}
        changed = {}
        for file, text in self._texts.items():
            numbered = [(number, mutant) for number, mutant in sorted(self._active.items())
                        if mutant.file == file]
            places = [place[1:] for place in sorted(demoted) if place[0] == file]
            changed[file] = schemata.rewrite(text, numbered, places)
        fresh = {file for file in changed if changed[file] != self._written.get(file)}
        self._written = changed
        self._tree.copy(changed)
        return [unit for unit, files in self._units.items() if fresh & files]

    def _drop(self, errors_of_units):
        """Leaves out the mutant at the first error of each unit: later ones may follow from it."""
        dropped = set()
        for errors in errors_of_units:
            found = next((number for places in errors
                          for number in [self._mutant_at(places)] if number), None)
            if found:
                dropped.add(found)
        if not dropped:
            raise BuildError("an error that no mutant explains, at\n  {}".format(
                "\n  ".join("{}:{}:{}".format(*place) for errors in errors_of_units
                            for places in errors for place in places[:1])))
        for number in dropped:
            del self._active[number]
        self.invalid |= dropped

    def _mutant_at(self, places):
        for file, line, column in places:
            if file in self._written:
                text = self._written[file].split("\n")[line - 1]
                near = [number for number in schemata.numbers_near(text, column)
                        if number in self._active]
                if near:
                    return near[0]
        return None
