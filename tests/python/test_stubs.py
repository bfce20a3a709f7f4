"""The stubs and the module say the same."""

import ast
import os
import re

import gsp

STUBS = os.path.join(os.environ["GSP_SOURCE"], "python", "gsp", "__init__.pyi")
TREE = ast.parse(open(STUBS, encoding="utf-8").read())
FUNCTIONS = {node.name: node for node in TREE.body if isinstance(node, ast.FunctionDef)}
CLASSES = {node.name: node for node in TREE.body if isinstance(node, ast.ClassDef)}


def test_every_name_has_a_stub_and_the_other_way_round():
    public = {name for name in gsp.__all__ if not name.startswith("_")}
    assert public == FUNCTIONS.keys() | CLASSES.keys()


def test_classes_have_the_same_members():
    for name, node in CLASSES.items():
        stub = {item.name for item in node.body if isinstance(item, ast.FunctionDef)} - {"__init__"}
        if name != "Error":
            assert stub == {m for m in vars(getattr(gsp, name)) if not m.startswith("_")}, name


def test_functions_take_the_same_keywords():
    for name in ("parameterize", "remesh", "encode", "curve"):
        documented = set()
        for words in re.findall(r"^    ([a-z_]+(?:, [a-z_]+)*)(?:: |\(|; )", getattr(gsp, name).__doc__, re.M):
            documented |= set(words.split(", "))
        stub = {argument.arg for argument in FUNCTIONS[name].args.kwonlyargs} - {"threads", "progress", "on_note"}
        assert stub == documented - {"threads", "progress", "on_note"}, name


def test_everything_is_documented():
    for name in gsp.__all__:
        assert name.startswith("__") or getattr(gsp, name).__doc__, name
