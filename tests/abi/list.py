"""Writes as text what programs that use the shared library depend on: python3 list.py ABIDW.xml SOVERSION.

One line a function, a type, a member or a value: names, offsets and sizes in bits. Functions that headers define are
compiled into those programs and are not listed; nor are types of other libraries.
"""

import subprocess
import sys
import xml.etree.ElementTree

OURS = ("_ZN7vdbcage", "_ZNK7vdbcage")
PRIVATE = ("_ZN7vdbcage6detail", "_ZNK7vdbcage6detail")


class Interface:
    def __init__(self, root):
        self.types = {}  # by id: the element, and the name of its scope
        self.functions = {}  # by symbol
        weak = {symbol.get("name") for symbol in root.iter("elf-symbol") if symbol.get("binding") == "weak-binding"}
        for unit in root.iter("abi-instr"):
            self._read(unit, "", weak)

    def _read(self, element, scope, weak):
        for child in element:
            name = scope + (child.get("name") or "")
            if child.get("id") and (child.get("id") not in self.types or not child.get("is-declaration-only")):
                self.types[child.get("id")] = child, name
            symbol = child.get("mangled-name") or ""
            if child.tag == "function-decl" and symbol.startswith(OURS) and not symbol.startswith(PRIVATE):
                if child.get("elf-symbol-id") and symbol not in weak:
                    self.functions[symbol] = child.find("return").get("type-id")
            inner = name + "::" if child.tag in ("namespace-decl", "class-decl", "union-decl") else scope
            if child.tag in ("namespace-decl", "class-decl", "union-decl", "member-type", "member-function"):
                self._read(child, inner, weak)

    def name(self, identifier):
        """The name of a type, as in a program."""
        element, name = self.types[identifier]
        if element.tag == "pointer-type-def":
            return self.name(element.get("type-id")) + "*"
        if element.tag == "reference-type-def":
            return self.name(element.get("type-id")) + ("&" if element.get("kind") == "lvalue" else "&&")
        if element.tag == "qualified-type-def":
            return self.name(element.get("type-id")) + (" const" if element.get("const") == "yes" else "")
        if element.tag == "array-type-def":
            return self.name(element.get("type-id")) + "".join(f"[{part.get('length')}]" for part in element)
        return name

    def lines(self):
        for identifier, (element, name) in self.types.items():
            if not name.startswith("vdbcage::") or name.startswith("vdbcage::detail::"):
                continue
            if element.tag == "enum-decl":
                underlying = self.types[element.find("underlying-type").get("type-id")][0]
                yield f"enum {name}: {underlying.get('size-in-bits')} bits"
                for value in element.iter("enumerator"):
                    yield f"enum {name}: {value.get('name')} = {value.get('value')}"
            if element.tag == "class-decl" and not element.get("is-declaration-only"):
                yield f"type {name}: {element.get('size-in-bits')} bits"
                for base in element.iter("base-class"):
                    yield f"type {name}: {base.get('layout-offset-in-bits')} base {self.name(base.get('type-id'))}"
                for member in element.findall("data-member"):
                    variable = member.find("var-decl")
                    if member.get("static") != "yes":
                        yield (f"type {name}: {int(member.get('layout-offset-in-bits')):5} {variable.get('name')}, "
                               f"{self.name(variable.get('type-id'))}")
                for member in element.findall("member-function"):
                    if member.get("vtable-offset"):
                        yield f"type {name}: virtual {member.get('vtable-offset')} {member[0].get('name')}"
        readable = subprocess.run(["c++filt"], input="\n".join(self.functions), text=True, capture_output=True, check=True)
        for function, result in zip(readable.stdout.splitlines(), self.functions.values()):
            yield f"function {function}: {self.name(result)}"


interface = Interface(xml.etree.ElementTree.parse(sys.argv[1]).getroot())
print(f"SOVERSION {sys.argv[2]}")
print("\n".join(sorted(set(interface.lines()))))
