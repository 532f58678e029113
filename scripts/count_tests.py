#!/usr/bin/env python3
"""Adds up the test results of a build and prints "N passed, N failed, N skipped".

usage: count_tests.py RESULTS_FOLDER CTEST_RESULTS CTEST_STATUS

Reads the JUnit files that gtest and rostest write, and ctest's own for the tests that write none.
Fails where a test failed, where ctest did, and where there were no results at all.
"""
import pathlib
import sys
import xml.etree.ElementTree


def count(case):
    """Returns (passed, failed, skipped) of a <testcase>."""
    if case.find("failure") is not None or case.find("error") is not None:
        return 0, 1, 0
    if case.find("skipped") is not None or case.get("result") == "skipped":
        return 0, 0, 1
    return 1, 0, 0


def cases(folder, ctest_results):
    """Yields every <testcase>, one for each test of each test program."""
    for path in sorted(pathlib.Path(folder).rglob("*.xml")):
        yield from xml.etree.ElementTree.parse(path).getroot().iter("testcase")
    for case in xml.etree.ElementTree.parse(ctest_results).getroot().iter("testcase"):
        # A whole gtest or rostest program, whose own file says more, or one without such a file.
        if case.get("name").startswith(("launch_", "lint_", "mutate_")):
            yield case


def main(folder, ctest_results, ctest_status):
    totals = [0, 0, 0]
    for case in cases(folder, ctest_results):
        totals = [total + one for total, one in zip(totals, count(case))]
        for skipped in case.findall("skipped"):
            print("skipped: {}.{}: {}".format(case.get("classname"), case.get("name"),
                                              (skipped.get("message") or "").strip()))
    passed, failed, skipped = totals
    if ctest_status != 0 and failed == 0:
        failed = 1  # a test program that crashed leaves no result of its own
    print("{} passed, {} failed, {} skipped".format(passed, failed, skipped))
    return 0 if failed == 0 and passed > 0 else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2], int(sys.argv[3])))
