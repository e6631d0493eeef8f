# SPDX-License-Identifier: Zlib
"""The stubs name what the modules have, with the same parameters and defaults."""
import ast
import inspect
import pathlib
import re

import pytest

import cairn
from cairn import _core

MODULES = [_core]
if cairn.has_builder:
    from cairn import _builder
    MODULES.append(_builder)


def stub_of(module):
    path = pathlib.Path(cairn.__file__).parent / (module.__name__.split(".")[1] + ".pyi")
    return ast.parse(path.read_text())


def public(names):
    return {name for name in names if not name.startswith("_")}


def functions_of(body):
    return {node.name: node for node in body if isinstance(node, ast.FunctionDef)}


def parameters(node):
    """(name, default) of each parameter; `*` stands before those that must be named."""
    given = node.args
    defaults = [None] * (len(given.args) - len(given.defaults)) + given.defaults
    listed = [(a.arg, ast.literal_eval(d) if d else ...) for a, d in zip(given.args, defaults) if a.arg != "self"]
    named = [(a.arg, ast.literal_eval(d) if d else ...) for a, d in zip(given.kwonlyargs, given.kw_defaults)]
    return listed + ([("*", ...)] if named else []) + named


def parameters_of_doc(doc):
    """The same from the signature in the first line that pybind11 writes."""
    inside = re.match(r"\w+\((.*)\) -> ", doc.split("\n")[0])[1]
    tree = ast.parse("def f(" + re.sub(r": [\w.]+(\[[^=]*\])?(?=,| =|$)", "", inside).replace(" = <", " = '<") + "): ...")
    return parameters(tree.body[0])


@pytest.mark.parametrize("module", MODULES, ids=lambda module: module.__name__)
def test_names_are_the_same_and_documented(module):
    body = stub_of(module).body
    classes = {node.name: node for node in body if isinstance(node, ast.ClassDef)}
    assert public(vars(module)) == public(classes) | public(functions_of(body))
    for name, node in classes.items():
        if name.startswith("_") or name == "Error":
            continue
        members = vars(getattr(module, name))
        assert public(members) == public(functions_of(node.body)), name
        assert {m for m in functions_of(node.body) if m.startswith("__")} <= set(members) | {"__hash__"}, name
        assert all(inspect.getdoc(member) for key, member in members.items() if not key.startswith("_")), name


@pytest.mark.parametrize("module", MODULES, ids=lambda module: module.__name__)
def test_parameters_and_defaults_are_the_same(module):
    compared = 0
    for name, node in functions_of(stub_of(module).body).items():
        assert parameters(node) == parameters_of_doc(getattr(module, name).__doc__) or has_overload(node), name
        compared += 1
    assert compared == len([1 for value in public(vars(module)) if inspect.isbuiltin(getattr(module, value))])


def has_overload(node):
    return any(isinstance(mark, ast.Name) and mark.id == "overload" for mark in node.decorator_list)


def test_the_package_shows_all_of_it():
    shown = {name for module in MODULES for name in public(vars(module))} | {"has_builder", "__version__"}
    assert set(cairn.__all__) == shown
    stub = ast.parse((pathlib.Path(cairn.__file__).parent / "__init__.pyi").read_text())
    stubbed = {alias.asname for node in stub.body if isinstance(node, ast.ImportFrom) for alias in node.names}
    assert shown - {"has_builder"} <= stubbed
    assert cairn.__version__ == _core.__version__ and re.fullmatch(r"\d+\.\d+\.\d+", cairn.__version__)
