"""The documents as typed dictionaries, from their JSON Schemas.

python tests/typed_dicts.py PALPATE > python/palpate/documents.py
"""

from __future__ import annotations

import json
import subprocess
import sys
from typing import Any

KINDS = ["scene", "tissue", "protocol", "indentation", "hemisphere", "tube", "uniaxial", "solid"]

HEADER = '''"""The documents of palpate as typed dictionaries, by which editors complete and type checkers check them.

A variable is checked that has the type of a document::

    from palpate import documents

    scene: documents.Scene = {"organ": {"builtin": "liver", "builtin_tissue": "pig-liver"}}

Every key is named with each unit that it is read in. Written by ``tests/typed_dicts.py`` from the JSON Schemas.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, TypedDict

if TYPE_CHECKING:
    from typing_extensions import Required


class Draw(TypedDict):
    """A value that is drawn anew for each attempt, by the name of its draw."""

    draw: str


class Estimate(TypedDict, total=False):
    """A value and its standard error."""

    value: Required[float]
    standard_error: float
'''

SIMPLE = {"number": "float", "integer": "int", "boolean": "bool", "string": "str"}


class Writer:
    """Classes of all kinds so far; equal tables of several kinds are one."""

    def __init__(self) -> None:
        self.classes: list[str] = []
        self.known: list[tuple[Any, str]] = []

    def kind(self, schema: dict[str, Any]) -> None:
        self.definitions = schema["$defs"]
        word = schema["title"].removeprefix("palpate ")
        self.table(schema, camel(word), schema["description"])

    def table(self, schema: dict[str, Any], name: str, meaning: str) -> str:
        """The name of the class of a table, which is written where it is met first."""
        # Definitions are numbered, and named by where they are.
        whole = self.whole(schema)
        for other, known in self.known:
            if other == whole:
                return known
        self.known.append((whole, name))
        # A file has its format; in a dictionary it may be left out.
        required = [key for key in schema.get("required", []) if key != "format"]
        lines = ["", "", f"class {name}(TypedDict, total=False):", *docstring(meaning), ""]
        last = None
        for key, holds in schema["properties"].items():
            of = self.type_of(holds, name + camel(key), holds.get("description", ""))
            lines.append(f"    {key}: {f'Required[{of}]' if key in required else of}")
            # The other units of a key say the same.
            if "description" in holds and holds["description"] != last:
                lines += docstring(holds["description"])
            last = holds.get("description")
        self.classes.append("\n".join(lines) + "\n")
        return name

    def whole(self, schema: Any) -> Any:
        """A schema without references."""
        if isinstance(schema, dict):
            if "$ref" in schema:
                return self.whole(self.definitions[schema["$ref"].rsplit("/", 1)[1]])
            return {key: self.whole(of) for key, of in schema.items() if key not in ("$defs", "$schema", "title")}
        return [self.whole(of) for of in schema] if isinstance(schema, list) else schema

    def type_of(self, schema: dict[str, Any], name: str, meaning: str) -> str:
        if "$ref" in schema:
            definition = schema["$ref"].rsplit("/", 1)[1]
            if definition == "drawn":
                return "Draw"
            return self.table(self.definitions[definition], name, meaning)
        if "anyOf" in schema:
            return " | ".join(dict.fromkeys(self.type_of(one, name, meaning) for one in schema["anyOf"]))
        if "enum" in schema or "const" in schema:
            words = schema.get("enum", [schema.get("const")])
            return f"Literal[{', '.join(json.dumps(word) for word in words)}]"
        kind = schema.get("type")
        if isinstance(kind, list):
            return " | ".join(SIMPLE[one] for one in kind)
        if kind == "array":
            return f"Sequence[{self.type_of(schema['items'], name, meaning)}]"
        if kind == "object":
            if "properties" in schema:
                assert set(schema["properties"]) == {"value", "standard_error"}, schema
                return "Estimate"
            inner = schema.get("additionalProperties")
            return f"Mapping[str, {self.type_of(inner, name, meaning) if inner else 'Any'}]"
        return SIMPLE[kind] if kind else "Any"


def camel(words: str) -> str:
    return "".join(part.capitalize() for part in words.replace("-", "_").split("_"))


def docstring(text: str) -> list[str]:
    text = text.replace("\\", "\\\\").replace('"""', "'''")
    return [f'    """{text}{" " if text.endswith(chr(34)) else ""}"""']


def module(schemas: list[dict[str, Any]]) -> str:
    writer = Writer()
    for schema in schemas:
        writer.kind(schema)
    return HEADER + "".join(writer.classes)


if __name__ == "__main__":
    printed = [
        subprocess.run([sys.argv[1], "scene", "--schema", kind], check=True, capture_output=True, text=True).stdout
        for kind in KINDS
    ]
    print(module([json.loads(one) for one in printed]), end="")
