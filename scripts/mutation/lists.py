"""The checked-in lists: mutants written by hand, and mutants that change nothing."""
import os

import yaml

from mutation import source
from mutation.mutant import Mutant


class ListError(Exception):
    """A list that does not fit the sources."""


def _entries(path, keys):
    if not os.path.exists(path):
        return []
    with open(path, encoding="utf-8") as file:
        entries = yaml.safe_load(file) or []
    for entry in entries:
        if set(entry) != set(keys):
            raise ListError("{}: expected the keys {}, got {}".format(
                path, ", ".join(keys), ", ".join(entry)))
    return entries


def read_named(path, finder):
    """Returns {name: mutant} of the entries whose file is among the mutated ones.

    The text of each becomes that of the smallest expression or statement around it, so that it nests
    with others.
    """
    named = {}
    for entry in _entries(path, ("name", "file", "old", "new")):
        if entry["name"] in named:
            raise ListError("{}: two mutants are named {}".format(path, entry["name"]))
        if entry["file"] in finder.texts:
            try:
                named[entry["name"]] = _named(entry, finder)
            except ListError as error:
                raise ListError("{}: mutant {}: {}".format(path, entry["name"], error)) from None
    return named


def _named(entry, finder):
    file, old, new = (entry[key].encode("utf-8").decode("latin-1").strip()
                      for key in ("file", "old", "new"))
    text = finder.texts[file]
    if text.count(old) != 1:
        raise ListError("{} holds its old text {} times, expected once:\n  {}".format(
            file, text.count(old), old))
    before = len(os.path.commonprefix([old, new]))
    after = len(os.path.commonprefix([old[before:][::-1], new[before:][::-1]]))
    start = text.index(old) + before
    end = start + len(old) - before - after
    new = new[before:len(new) - after]

    def changed(host):
        return source.flat(text[host[1]:start] + new + text[end:host[2]])

    around = [host for host in finder.hosts if host[0] == file and host[1] <= start and
              end <= host[2] and (host[3] or changed(host))]
    if not around:
        raise ListError("no expression or statement of {} holds what changes".format(file))
    host = min(around, key=lambda each: (each[2] - each[1], each[3]))
    wrap, demoted = finder.hosts[host]
    return Mutant(*host[:3], changed(host), host[3], wrap, demoted)


def read_equivalent(path, texts):
    """Returns {(file, line, mutation): argument} of the entries whose file is mutated."""
    equivalent = {}
    for entry in _entries(path, ("file", "line", "mutation", "argument")):
        if entry["file"] not in texts:
            continue
        lines = source.readable(texts[entry["file"]]).split("\n")
        if entry["line"] not in (line.strip() for line in lines):
            raise ListError("{}: {} has no such line:\n  {}".format(
                path, entry["file"], entry["line"]))
        equivalent[entry["file"], entry["line"], entry["mutation"]] = entry["argument"]
    return equivalent
