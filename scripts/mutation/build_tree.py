"""A copy of the source tree with mutants in it, and its build."""
import json
import os
import pathlib
import re
import shutil
import subprocess

from mutation import schemata, source

TEST_FOLDERS = ("test/core", "test/synthetic")
ENVIRONMENT = {**os.environ, "PATH": "/usr/bin:/bin:/usr/sbin:/sbin", "LC_ALL": "C"}


class BuildError(Exception):
    """A build that failed for another reason than a mutant."""


def tracked(root):
    """Returns the files of the working tree, without ignored ones."""
    command = ["git", "-C", str(root), "ls-files", "-z", "--cached", "--others",
               "--exclude-standard"]
    names = subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout.decode().split("\0")
    return [name for name in names if (pathlib.Path(root) / name).is_file()]


class BuildTree:
    """The copy below `folder`; files that do not change keep their time, so that make is quick."""

    def __init__(self, root, folder):
        self.root = pathlib.Path(root).resolve()
        self.folder = pathlib.Path(folder).resolve()
        self.sources = self.folder / "tree"
        self.build = self.folder / "build"

    def copy(self, changed, kept=()):
        """Makes the copy equal to the tree, with `changed` texts of some files.

        Files that end with one of `kept` stay as an earlier run left them.
        """
        names = set(tracked(self.root))
        for name in sorted(names):
            path = self.sources / name
            if name.endswith(tuple(kept)) and path.exists():
                continue
            text = changed.get(name) or source.read(self.root / name)
            if not path.exists() or source.read(path) != text:
                path.parent.mkdir(parents=True, exist_ok=True)
                source.write(path, text)
            shutil.copymode(self.root / name, path)
        for path in [path for path in self.sources.rglob("*") if not path.is_dir()]:
            if str(path.relative_to(self.sources)) not in names:
                path.unlink()

    def configure(self):
        query = self.build / ".cmake/api/v1/query/codemodel-v2"
        query.parent.mkdir(parents=True, exist_ok=True)
        query.touch()
        header = self.folder / "mutant.h"
        if not header.exists() or source.read(header) != schemata.HEADER:
            source.write(header, schemata.HEADER)
        status, output = self._run([
            "cmake", "-S", self.sources, "-B", self.build, "-DCATKIN_ENABLE_TESTING=ON",
            "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON",
            # With assertions an index or an optional that is none stops the program at once.
            "-DCMAKE_CXX_FLAGS=-w -D_GLIBCXX_ASSERTIONS -include {}".format(header),
            "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG"])
        if status != 0:
            raise BuildError(output)

    def commands(self):
        """Returns {source file: compiler command} of the original files."""
        with open(self.build / "compile_commands.json", encoding="utf-8") as file:
            entries = json.load(file)
        return {os.path.relpath(entry["file"], self.sources): entry["command"] for entry in entries}

    def test_programs(self):
        """Returns {target: path} of the programs of the folders with the fast tests."""
        programs = {}
        for path in (self.build / ".cmake/api/v1/reply").glob("target-*.json"):
            with open(path, encoding="utf-8") as file:
                target = json.load(file)
            if target["type"] == "EXECUTABLE" and target["paths"]["source"] in TEST_FOLDERS:
                programs[target["name"]] = self.build / target["artifacts"][0]["path"]
        return programs

    def make(self, targets, jobs):
        """Returns the errors as lists of (file, line, column), each with its notes."""
        status, output = self._run(["cmake", "--build", self.build, "-j", str(jobs), "--target",
                                    *sorted(targets), "--", "-k"])
        if status == 0:
            return []
        errors = self._errors(output)
        if not errors:
            raise BuildError(output[-6000:])
        return errors

    def check(self, name, command):
        """Compiles a file without a result; returns its errors as `make` does."""
        arguments = re.sub(r" -o \S+", "", command) + " -fsyntax-only"
        process = subprocess.run(arguments, shell=True, cwd=self.build, env=ENVIRONMENT,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        output = process.stdout.decode("utf-8", "replace")
        errors = self._errors(output)
        if process.returncode != 0 and not errors:
            raise BuildError("{}:\n{}".format(name, output[-6000:]))
        return errors

    def _run(self, command):
        process = subprocess.run(list(map(str, command)), env=ENVIRONMENT, check=False,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        return process.returncode, process.stdout.decode("utf-8", "replace")

    def _errors(self, output):
        errors = []
        for match in re.finditer(r"^(/\S+?):(\d+):(\d+): (error|fatal error|note): (.*)$", output,
                                 re.M):
            place = os.path.relpath(match.group(1), self.sources), *map(int, match.group(2, 3))
            if match.group(4) != "note":
                errors.append((match.group(5), []))
            if errors:
                errors[-1][1].append(place)
        # What is no constant any more is used in one place and declared in the other, which is the
        # note's.
        return [places[1:] + places[:1] if "constant" in message else places
                for message, places in errors]
