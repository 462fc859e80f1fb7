# SPDX-License-Identifier: BSD-3-Clause
"""Writes the package's type stubs from the package itself, its table of parameters included.

    make_stubs.py PACKAGE_FOLDER

Run when the package is built, with it on PYTHONPATH. Of VTK's classes the stubs have the methods that are
of this package, with the types that their help tells.
"""

import inspect
import os
import re
import sys

HEAD = '''# SPDX-License-Identifier: BSD-3-Clause
# Made by make_stubs.py when the package is built.

import os
from typing import Any, Dict, List, Literal, Mapping, Optional, Sequence, Tuple, Union, overload

import numpy
import numpy.typing
%(bases)s

Array = numpy.ndarray
ArrayLike = numpy.typing.ArrayLike
Color = Union[str, float, Sequence[float]]
Pair = Sequence[float]
FileName = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]
Light = Union[Sequence[float], Mapping[str, Any], vtkLight]
Moment = Union[Sequence[Any], Mapping[str, Any]]
Layer = Literal[%(layers)s]
Preset = Literal[%(presets)s]

__version__: str

def parameters() -> List[Dict[str, Any]]: ...
def shade(heights: ArrayLike, *, %(shade)s) -> ReliefImage: ...
def shade_pieces(shading: vtkImageReliefShading, file: Union[str, os.PathLike], comm: Any = ..., *,
                 memory: Optional[float] = ..., cloud_optimized: bool = ...,
                 overviews: bool = ...) -> int: ...
def update(algorithm: vtkAlgorithm) -> None: ...
def read_scene(file_name: FileName) -> vtkReliefScene: ...
def write_scene(scene: vtkReliefScene, file_name: FileName) -> None: ...

class ReliefWarning(UserWarning): ...

class raise_errors:
    def __init__(self) -> None: ...
    def stop(self) -> None: ...
    def __enter__(self) -> raise_errors: ...
    def __exit__(self, *_: Any) -> None: ...

class Relief:
    shape: Tuple[int, int]
    scene: vtkReliefScene
    filter: vtkImageReliefShading
    def __init__(self, heights: ArrayLike, *, cache_memory_limit: float = ..., %(shade)s) -> None: ...
    def set_heights(self, heights: ArrayLike, *, %(heights)s) -> None: ...
    def shade(self, *, %(picture)s) -> ReliefImage: ...

class ReliefImage:
    image: Array
    layers: Dict[str, Array]
    statistics: Dict[str, Any]
    mask: Array
    shape: Tuple[int, int, int]
    dtype: numpy.dtype
    ndim: int
    size: int
    def __array__(self, dtype: Any = ..., copy: Union[bool, None] = ...) -> Array: ...
    def __getitem__(self, index: Any) -> Any: ...
    def __len__(self) -> int: ...
    def tobytes(self) -> bytes: ...
    def encoded(self) -> Array: ...
    def save(self, file_name: FileName) -> None: ...
'''

OF_FIXED = {
    "spacing": "Union[float, Pair]", "mask": "Union[ArrayLike, None]", "nodata": "Union[float, None]",
    "sun": "Union[Light, None]", "suns": "Union[Sequence[Light], None]",
    "sun_at": "Union[Moment, None]", "lamp": "Union[Light, None]",
    "lamps": "Union[Sequence[Light], None]", "preset": "Union[Preset, None]",
    "environment": "Union[ArrayLike, vtkReliefEnvironment, None]",
    "depth": 'Union[float, Literal["auto"], None]',
    "diffuse_texture": "Union[ArrayLike, None]", "base_texture": "Union[ArrayLike, None]",
    "specular_texture": "Union[ArrayLike, None]", "cmap": "Any", "clim": "Union[Pair, None]",
    "layers": 'Union[Layer, Literal["all"], Sequence[Layer]]', "dtype": "numpy.typing.DTypeLike",
    "alpha": "bool", "background": "Color", "scene": "Union[vtkReliefScene, FileName, None]"}
OF_KIND = {"number": "float", "length": 'Union[float, Literal["infinite"]]', "count": "int", "flag": "bool",
           "color": "Color", "range": "Pair"}


def type_of(name, keywords):
    """The type of a keyword of shade()."""
    if name in OF_FIXED:
        return OF_FIXED[name]
    row = keywords.TABLE[name]
    if row["kind"] == "choice":
        return "Literal[%s]" % ", ".join(repr(keywords.word_of(choice)) for choice in row["choices"])
    kind = OF_KIND[row["kind"]]
    return f'Union[{kind}, Literal["auto"]]' if name in keywords.AUTOMATIC else kind


def arguments_of(function, keywords):
    return ", ".join(f"{name}: {type_of(name, keywords)} = ..."
                     for name, parameter in inspect.signature(function).parameters.items()
                     if parameter.kind is parameter.KEYWORD_ONLY)


# ------------------------------------------------------------------------------
def type_of_help(text, classes):
    """A type as VTK's help tells it."""
    text = (text or "").strip()
    if re.fullmatch(r"bool|int|float|str|None", text) or text in classes:
        return text
    if re.fullmatch(r"\((float|int)(, \1)*\)", text):
        return f"Tuple[{text[1:-1]}]"
    return "Any"


def signatures(name, text, classes):
    """What a method's help tells of its arguments, one for each overload."""
    found = []
    for match in re.finditer(rf"^{name}\((.*?)\)\s*->\s*(.*?)\nC\+\+:", text, re.MULTILINE | re.DOTALL):
        listed = re.sub(r"\s+", " ", match[1])
        # Commas within brackets belong to one argument.
        items = re.findall(r"(?:\[[^]]*\]|\([^)]*\)|[^,])+", listed)
        arguments, static = [], not listed.startswith("self")
        for item in items if static else items[1:]:
            parts = re.fullmatch(r"\s*(\w+)\s*:\s*(.*?)\s*(=.*)?", item)
            if not parts:
                return []
            default = " = ..." if parts[3] else ""
            argument = parts[1] if parts[1] not in ("None", "from", "in", "lambda") else parts[1] + "_"
            arguments.append(f"{argument}: {type_of_help(parts[2], classes)}{default}")
        found.append((static, arguments, type_of_help(match[2], classes)))
    return found


def method_lines(name, method, classes):
    found = signatures(name, getattr(method, "__doc__", None) or "", classes)
    if not found:
        return [f"    def {name}(self, *arguments: Any) -> Any: ..."]
    lines = []
    for static, arguments, result in found:
        lines += ["    @overload"] if len(found) > 1 else []
        lines += ["    @staticmethod"] if static else []
        listed = ", ".join(arguments if static else ["self", *arguments])
        lines.append(f"    def {name}({listed}) -> {result}: ...")
    return lines


def class_lines(kind, classes):
    base = kind.__bases__[0].__name__
    lines = ["", f"class {kind.__name__}({base}):"]
    for name, member in sorted(vars(kind).items()):
        if name.startswith("_") or name in ("override",):
            continue
        if isinstance(member, int):
            lines.append(f"    {name}: int")
        elif isinstance(member, type):
            lines.append(f"    class {name}(int): ...")
        else:
            lines += method_lines(name, member, classes)
    return lines + ([] if len(lines) > 2 else ["    ..."])


def main():
    import reliefshading
    from reliefshading import Relief, _keywords, _lights, shade

    names = [name for name in reliefshading.__all__ if name.startswith("vtk")]
    kinds = [getattr(reliefshading, name) for name in names]
    bases = {"vtkAlgorithm": "vtkmodules.vtkCommonExecutionModel", "vtkLight": "vtkmodules.vtkRenderingCore"}
    for kind in kinds:
        if kind.__bases__[0].__name__ not in names:
            bases[kind.__bases__[0].__name__] = kind.__bases__[0].__module__
    text = HEAD % {
        "bases": "\n".join(f"from {bases[name]} import {name}" for name in sorted(bases)),
        "layers": ", ".join(repr(layer) for layer in _keywords.LAYERS),
        "presets": ", ".join(repr(preset) for preset in _lights.PRESETS),
        "shade": arguments_of(shade, _keywords),
        "picture": arguments_of(Relief.shade, _keywords),
        "heights": ", ".join(f"{name}: {OF_FIXED[name]} = ..." for name in _keywords.OF_HEIGHTS)}
    for kind in kinds:
        text += "\n".join(class_lines(kind, [*names, *bases])) + "\n"
    folder = sys.argv[1]
    with open(os.path.join(folder, "__init__.pyi"), "w", encoding="utf-8") as file:
        file.write(text)
    with open(os.path.join(folder, "py.typed"), "w", encoding="utf-8"):
        pass


if __name__ == "__main__":
    main()
