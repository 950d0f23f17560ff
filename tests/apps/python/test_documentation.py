import ast
import doctest
import importlib
import inspect
import os
import pathlib
import subprocess
import sys

import pytest

import runnel

SOURCES = pathlib.Path(os.environ["RUNNEL_XML"]).parent / "apps/python"
MODULES = ["runnel", "runnel._extension", "runnel._modules", "runnel._types", "runnel.application", "runnel.arena", "runnel.plot",
           "runnel.recordings", "runnel.remote"]


@pytest.mark.parametrize("name", MODULES)
def test_doctests(name, xml):
    if name == "runnel.recordings":
        with runnel.load(xml / "apps/bug_demo.xml", speed=0, record="recorded.mcap") as app:
            app.run_for(1)
    names = {"runnel": runnel, "xml": xml, "recorded": "recorded.mcap"}
    module = importlib.import_module(name)
    tests = doctest.DocTestFinder(exclude_empty=True).find(module, extraglobs=names)
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    for each in tests:
        runner.run(each)
    assert runner.failures == 0


def test_the_doctests_are_found():
    count = sum(len(test.examples) for name in MODULES for test in doctest.DocTestFinder().find(importlib.import_module(name)))
    assert count >= 15


@pytest.mark.parametrize("example", sorted(each.name for each in (SOURCES / "examples").glob("*.py")))
def test_examples_run(example, xml):
    done = subprocess.run([sys.executable, str(SOURCES / "examples" / example), str(xml)], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_there_are_three_examples():
    assert len(list((SOURCES / "examples").glob("*.py"))) == 3


def stubbed(tree):
    """Class or "" -> names of what the stubs have in it."""
    found = {"": set()}
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            found[node.name] = {each.name for each in node.body if isinstance(each, (ast.FunctionDef, ast.AsyncFunctionDef))}
            found[node.name] |= {each.target.id for each in node.body if isinstance(each, ast.AnnAssign)}
            found[""].add(node.name)
        elif isinstance(node, ast.FunctionDef):
            found[""].add(node.name)
    return found


def test_stubs_have_what_there_is():
    stubs = stubbed(ast.parse((SOURCES / "runnel/__init__.pyi").read_text()))
    assert set(runnel.__all__) - {"types", "arena", "plot"} <= stubs[""]
    for name in ("Application", "Remote", "Recording", "Reader", "Writer", "Value", "Type", "Module"):
        there = {each for each, _ in inspect.getmembers(getattr(runnel, name)) if not each.startswith("_")}
        said = {each for each in stubs[name] if not each.startswith("_")}
        assert there <= said and said - there <= {"file", "name", "process"}, name
