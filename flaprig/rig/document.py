"""The text of a rig's file: reading it whole, editing one attribute of it, saving it elsewhere.

A rig carries its file as text, so that what Python has no name for stays as it was written, and
so that a rig can be compared, pickled and saved after the file has changed.
"""

from __future__ import annotations

import os
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path
from xml.parsers import expat

import mujoco

from flaprig.files import written_whole

# elements of <asset> whose attribute `file` is a path, and the folder that <compiler> gives it
_FOLDERS = {
    "mesh": "meshdir",
    "skin": "meshdir",
    "hfield": "meshdir",
    "texture": "texturedir",
    "model": "",
}


@dataclass(frozen=True)
class Document:
    """An MJCF file as text, with what it includes in place.

    Attributes:
        text: the XML.
        folder: where the files that it names are looked for.
    """

    text: str
    folder: Path

    @classmethod
    def read(cls, path: Path) -> Document:
        """The document in a file.

        Raises:
            OSError: the file cannot be read.
            ValueError: the file, or one that it includes, is no well-formed XML.
        """
        data = path.read_bytes()
        root, folder = _parsed(data, path), path.resolve().parent
        try:
            text = data.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = ET.tostring(root, "unicode")
        if root.find(".//include") is None:
            return cls(text, folder)
        _include(root, folder, (path.resolve(),))
        return cls(text, folder).edited(root)

    def root(self) -> ET.Element:
        """The root element, a copy that may be changed."""
        return _parsed(self.text.encode(), self.folder)

    def edited(self, root: ET.Element) -> Document:
        """The same document with another root element; comments before it are kept."""
        data, start = self.text.encode(), _start_of_root(self.text)
        head = data[:start].decode()
        # the declaration would name an encoding that the text no longer has
        head = head[head.index("?>") + 2 :].lstrip() if head.startswith("<?xml") else head
        body = ET.tostring(root, "unicode").replace(" />", "/>")
        return Document(f"{head}{body}\n", self.folder)

    def spec(self) -> mujoco.MjSpec:
        """The document as MuJoCo reads it, not yet compiled.

        Raises:
            ValueError: MuJoCo's own words.
        """
        spec = mujoco.MjSpec.from_string(self.text)
        spec.modelfiledir = str(self.folder)
        return spec

    def save(self, path: Path) -> None:
        """Write the document, whole or not at all; files that it names are found from there, too.

        Raises:
            OSError: the folder does not exist or cannot be written.
        """
        with written_whole(path) as draft:
            draft.write_text(self._moved(path.resolve().parent).text, encoding="utf-8")

    def _moved(self, folder: Path) -> Document:
        """The document as it must stand in another folder."""
        root = self.root()
        named = [e for e in root.iterfind(".//asset/*[@file]") if e.tag in _FOLDERS]
        if folder == self.folder or not named:
            return self
        compilers = root.findall("compiler")
        options = {key: value for compiler in compilers for key, value in compiler.items()}
        for element in named:
            file = Path(element.get("file", ""))
            if options.get("strippath") == "true":
                file = Path(file.name)
            given = _FOLDERS[element.tag]
            inside = options.get(given, options.get("assetdir", "")) if given else ""
            element.set("file", os.path.relpath(self.folder / inside / file, folder))
        for compiler in compilers:
            for key in ("meshdir", "texturedir", "assetdir", "strippath"):
                compiler.attrib.pop(key, None)
        return Document(self.edited(root).text, folder)


def add(parent: ET.Element, tag: str, **attributes: str) -> ET.Element:
    """A new last child, on a line of its own where its siblings are."""
    child = ET.SubElement(parent, tag, attributes)
    before = list(parent)[:-1]
    if before:
        child.tail, before[-1].tail = before[-1].tail, before[0].tail if before[1:] else parent.text
    return child


def section(root: ET.Element, tag: str) -> ET.Element:
    """The first section of that name, made where there is none."""
    found = root.find(tag)
    return add(root, tag) if found is None else found


def _parsed(data: bytes, path: Path) -> ET.Element:
    parser = ET.XMLParser(target=ET.TreeBuilder(insert_comments=True))
    try:
        return ET.fromstring(data, parser)
    except (ET.ParseError, ValueError, LookupError) as error:
        raise ValueError(f"Rig.load: {path} must be well-formed XML, got: {error}") from None


def _start_of_root(text: str) -> int:
    """Where the root element begins, in bytes of UTF-8."""
    found: list[int] = []
    parser = expat.ParserCreate("utf-8")

    def begin(name: str, attributes: dict[str, str]) -> None:
        found.append(parser.CurrentByteIndex)

    parser.StartElementHandler = begin
    parser.Parse(text.encode(), True)
    return found[0]


def _include(element: ET.Element, folder: Path, above: tuple[Path, ...]) -> None:
    """Put the children of included files where the includes are, as MuJoCo does."""
    for child in list(element):
        if child.tag != "include":
            _include(child, folder, above)
            continue
        path = (folder / child.get("file", "")).resolve()
        if path in above:
            raise ValueError(f"Rig.load: {above[0]} must not include itself, got {path}")
        if not path.is_file():
            raise FileNotFoundError(f"Rig.load: {above[0]} includes {path}, which is no file")
        part = _parsed(path.read_bytes(), path)
        _include(part, folder, (*above, path))
        place = list(element).index(child)
        element.remove(child)
        for k, new in enumerate(part):
            element.insert(place + k, new)
