#!/usr/bin/python3
"""Tests the mutation test with a sample: what each of its mutants gives."""
import contextlib
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "scripts"))
# pylint: disable=wrong-import-position
from mutation import draw, lists, operators, result, run, schemata, source, units  # noqa: E402
from mutation.finder import Finder  # noqa: E402

# What the sample prints, by place.
PLACES = ("below", "nested", "both", "negative", "twice", "vectors", "firstEven", "clamped", "sizes",
          "steps(true)", "steps(false)")
ORIGINAL = "0 13 0 -6 6 8 4 10 4 10 5".split()

# (mutation, place, what it gives); several places where more than one changes.
EXPECTED = [
    ("a < b -> a <= b", {"below": "1"}),
    ("a < b -> a >= b", {"below": "1"}),
    ("a + b * (c - 1) -> a - (b * (c - 1))", {"nested": "1"}),
    ("b * (c - 1) -> b / (c - 1)", {"nested": "7"}),
    ("c - 1 -> c + 1", {"nested": "17"}),
    ("1 -> 1 * 0", {"nested": "15"}),
    ("a && !b -> a || (!b)", {"both": "1"}),
    ("!b -> (b)", {"both": "1"}),
    ("-x -> (x)", {"negative": "6"}),
    ("3.0 -> 3.0 * 2", {"negative": "-12"}),
    ("3.0 -> 3.0 / 2.0", {"negative": "-3"}),
    ("-x * kFactor -> (-x) / kFactor", {"negative": "-0.666667"}),
    ("x + x -> x - x", {"twice": "0"}),
    ("hn::Add(a, b) -> hn::Sub(a, b)", {"vectors": "2"}),
    ("continue; -> (deleted)", {"firstEven": "3"}),
    ("return 10; -> (deleted)", {"clamped": "12"}),
    ("often -> !(often)", {"steps(true)": "5", "steps(false)": "10"}),
    ("counter += Counter::kStep; -> (deleted)", {"steps(true)": "5"}),
    ("5 -> 5 * 2", {"steps(true)": "20", "steps(false)": "10"}),
    ("total += by; -> (deleted)", {"steps(true)": "0", "steps(false)": "0"}),
    ("total += by -> total -= by", {"steps(true)": "-10", "steps(false)": "-5"}),
]


def compile_sample(folder, header):
    """Returns the compiler's output, empty where it succeeds."""
    source.write(folder / "sample.h", header)
    source.write(folder / "mutant.h", schemata.HEADER)
    process = subprocess.run(
        ["g++", "-std=c++17", "-include", str(folder / "mutant.h"), "-I", str(folder),
         "-iquote", str(folder), "-x", "c++", "-", "-o", str(folder / "sample")],
        input=source.read(HERE / "sample_test.cpp").encode("latin-1"), stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, check=False)
    return process.stdout.decode() if process.returncode else ""


class Sample(unittest.TestCase):
    """All mutants of the sample in one program, without the one that cannot be compiled."""

    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.holder.name)
        cls.finder = Finder(HERE, ["sample.h"])
        cls.finder.visit_unit(units.parse(HERE / "sample_test.cpp", ["-std=c++17"]))
        cls.text = cls.finder.texts["sample.h"]
        in_order = sorted(cls.finder.mutants)
        cls.all = dict(enumerate(in_order, 1))
        cls.size = {number for number, mutant in cls.all.items()
                    if "kUsedAsSize" in mutant.line(cls.text)[1]}
        cls.usable = {number: mutant for number, mutant in cls.all.items()
                      if number not in cls.size}
        errors = compile_sample(cls.folder, cls.rewritten(cls.usable))
        assert not errors, errors

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    @classmethod
    def rewritten(cls, numbered):
        demoted = {place[1:] for mutant in numbered.values() for place in mutant.demoted}
        return schemata.rewrite(cls.text, sorted(numbered.items()), sorted(demoted))

    def number(self, mutation):
        """Returns the first mutant with a description, leaving out those on kUsedAsSize."""
        return next(number for number, mutant in self.usable.items()
                    if mutant.describe(self.text) == mutation)

    def outputs(self, number):
        environment = {**os.environ, schemata.VARIABLE: str(number)}
        return subprocess.run([str(self.folder / "sample")], env=environment, check=True,
                              stdout=subprocess.PIPE).stdout.decode().split()


class MutationTest(Sample):
    """Mutants, their draw, and their test."""

    def test_without_a_mutant_nothing_changes(self):
        self.assertEqual(self.outputs(0), ORIGINAL)

    def test_each_mutant_changes_what_it_should(self):
        for mutation, changes in EXPECTED:
            with self.subTest(mutation):
                expected = [changes.get(place, value) for place, value in zip(PLACES, ORIGINAL)]
                self.assertEqual(self.outputs(self.number(mutation)), expected)

    def test_lines_stay_where_they_are(self):
        self.assertEqual(self.rewritten(self.usable).count("\n"), self.text.count("\n"))

    def test_compiler_names_the_mutant_of_a_constant_that_has_to_be_one(self):
        self.assertTrue(self.size)
        rewritten = self.rewritten(self.all)
        with tempfile.TemporaryDirectory() as folder:
            errors = compile_sample(pathlib.Path(folder), rewritten)
        self.assertIn("constant", errors)
        line = next(line for line in rewritten.split("\n") if "kUsedAsSize =" in line)
        self.assertEqual(set(schemata.numbers_near(line, len(line))), self.size)

    def test_good_test_kills_what_a_weak_one_lets_live(self):
        for kind in ("weak", "good"):
            program = self.folder / kind
            program.write_text('#!/bin/sh\nexec "{}" {}\n'.format(self.folder / "sample", kind))
            program.chmod(0o755)
        boundary, opposite = (self.number("a < b -> a " + sign + " b") for sign in ("<=", ">="))
        for kind, killed in (("weak", [opposite]), ("good", [boundary, opposite])):
            runner = run.Runner({kind: self.folder / kind}, {})
            _, failed = runner.measure()
            self.assertEqual(failed, {})
            self.assertEqual([number for number in (boundary, opposite)
                              if runner.killer(number)[0]], killed)

    def test_draw_repeats_with_its_seed_and_takes_each_mutant_once(self):
        draws = []
        for _ in range(2):
            draw_all = draw.Draw(self.finder.mutants, self.finder.texts, 7)
            draws.append([draw_all.next() for _ in self.finder.mutants])
            self.assertIsNone(draw_all.next())
        self.assertEqual(draws[0], draws[1])
        self.assertEqual(set(draws[0]), self.finder.mutants)

    def test_literals(self):
        self.assertEqual(operators.literal_variants("1", False), ["1 * 0", "1 * 2"])
        self.assertEqual(operators.literal_variants("1", True), ["1 * 0", "1 * 2", "1 / 2.0"])
        self.assertEqual(operators.literal_variants("0.0F", False), ["0.0F + 1"])
        self.assertEqual(operators.literal_variants("0x1F", False),
                         ["0x1F * 0", "0x1F * 2", "0x1F / 2"])


class ListsTest(Sample):
    """Mutants by hand, and the list of those that change nothing."""

    def read(self, text, reader, argument):
        path = self.folder / "list.yaml"
        path.write_text(text)
        return reader(str(path), argument)

    def test_named_mutant_is_that_of_the_smallest_expression_around_it(self):
        named = self.read("- {name: wide, file: sample.h, old: 'return a + b * (c - 1)', "
                          "new: 'return a + b * (c - 8)'}", lists.read_named, self.finder)
        self.assertEqual(named["wide"].describe(self.text), "1 -> 8")

    def test_named_mutant_whose_text_is_not_there_is_an_error(self):
        with self.assertRaisesRegex(lists.ListError, "mutant lost: sample.h holds its old text 0"):
            self.read("- {name: lost, file: sample.h, old: a ** b, new: a}", lists.read_named,
                      self.finder)

    def test_line_of_an_equivalent_mutant_has_to_be_there(self):
        with self.assertRaisesRegex(lists.ListError, "sample.h has no such line"):
            self.read("- {file: sample.h, line: return z;, mutation: z -> y, argument: none}",
                      lists.read_equivalent, self.finder.texts)


class ResultTest(unittest.TestCase):
    """When a run succeeds."""

    def summary(self, **counts):
        """Returns whether so many drawn mutants of each status are good enough, and the text."""
        results = [result.Result("1", False, "a.cpp", 1, "a < b", "< -> <=", status, "", "")
                   for status, count in counts.items() for _ in range(count)]
        results.append(result.Result("name", True, "a.cpp", 1, "a", "a -> b", self.named, "", ""))
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            good = result.summarise(results, 0, 1.0)
        return good, printed.getvalue()

    def setUp(self):
        self.named = "killed"

    def test_score_counts_those_that_are_not_equivalent(self):
        good, text = self.summary(killed=19, survived=1, equivalent=2)
        self.assertTrue(good)
        self.assertIn("score: 95.0% of those not equivalent, 86.4% of all drawn", text)
        self.assertFalse(self.summary(killed=18, survived=1, equivalent=2)[0])

    def test_survivors_are_printed(self):
        self.assertIn("1  a.cpp:1\n    a < b\n    < -> <=", self.summary(survived=1)[1])

    def test_too_many_or_wrong_excuses_fail(self):
        self.assertTrue(self.summary(killed=18, equivalent=2)[0])
        self.assertFalse(self.summary(killed=17, equivalent=2)[0])
        self.assertFalse(self.summary(killed=20, contradicted=1)[0])

    def test_surviving_named_mutant_fails(self):
        self.named = "survived"
        self.assertFalse(self.summary(killed=20)[0])


if __name__ == "__main__":
    unittest.main()
