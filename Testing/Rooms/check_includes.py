# SPDX-License-Identifier: BSD-3-Clause
"""Holds the includes of Module against the rooms of Documentation/Architecture.md.

    check_includes.py MODULE_FOLDER

Fails where a room includes a header of a room that it may not know, where two headers of libraries have one
name, where files of one room include each other in a circle, and where that page does not name a header.
"""

import pathlib
import re
import sys

# What each room may include beside itself. Arrows go down.
MAY_INCLUDE = {
    "Model": set(),
    "Shaders": {"Model"},
    "Imaging/Hosts": {"Model", "Imaging"},
    "Imaging": {"Model", "Imaging/Hosts"},
    "Rendering": {"Model", "Shaders", "Imaging", "Imaging/Hosts"},
    "Interaction": {"Model", "Imaging", "Imaging/Hosts"},
    "Files/Core": set(),
    "Files": {"Files/Core"},
    "IO": {"Model", "Imaging", "Imaging/Hosts", "Files", "Files/Core"},
    "Raster": {"Model", "Imaging", "Imaging/Hosts", "Files", "Files/Core"},
    "Streaming": {"Model", "Imaging", "Imaging/Hosts", "Files", "Files/Core", "Raster"},
    "Heights/Core": {"Model"},
    "Heights": {"Model", "Imaging", "Imaging/Hosts", "Heights/Core"},
    "Web": {"Imaging"},
    "Web/wasm": {"Model", "Files/Core", "Heights/Core"},
    "ParaView": {"Imaging"},
    "ParaView/Adapters": {"Imaging", "Imaging/Hosts", "IO", "Rendering"},
    "Programs/reliefshade": {"Imaging", "Imaging/Hosts", "Files", "Files/Core", "IO", "Raster", "Streaming", "Heights"},
    "Programs/reliefviewer": {"Imaging", "Imaging/Hosts", "Files", "Files/Core", "IO", "Raster", "Streaming", "Heights", "Rendering",
                              "Interaction", "Programs/reliefshade"},
}
# What a room's code must never name, whoever brings it.
NEVER = {
    "Model": r"vtk|OpenImageIO|Imf|gdal|ogr|Q[A-Z]|fstream|cstdio",
    "Shaders": r"vtk|OpenImageIO|Imf|gdal|ogr|Q[A-Z]|fstream|cstdio",
    "Imaging/Hosts": r"vtkOpenGL|vtk_gl|OpenImageIO|Imf|gdal|ogr|Q[A-Z]|fstream|cstdio",
    "Imaging": r"vtkOpenGL|vtk_gl|OpenImageIO|Imf|gdal|ogr|Q[A-Z]|fstream|cstdio",
    "Interaction": r"vtkOpenGL|vtk_gl|OpenImageIO|Imf|gdal|ogr|Q[A-Z]|fstream",
    "Heights/Core": r"vtk|OpenImageIO|Imf|gdal|ogr|Q[A-Z]|fstream|cstdio",
    "Heights": r"vtkOpenGL|vtk_gl|OpenImageIO|Imf|gdal|ogr|Q[A-Z]|fstream|cstdio",
    "Rendering": r"OpenImageIO|Imf|gdal|ogr|Q[A-Z]|fstream",
    "Files/Core": r"vtk|OpenImageIO|Imf|gdal|ogr|Q[A-Z]|fstream|cstdio",
    "Files": r"vtkOpenGL|vtk_gl|OpenImageIO|Imf|gdal|ogr|Q[A-Z]",
    "IO": r"vtkOpenGL|vtk_gl|gdal|ogr|Q[A-Z]",
    "Raster": r"vtkOpenGL|vtk_gl|OpenImageIO|Imf|Q[A-Z]",
    "Streaming": r"vtkOpenGL|vtk_gl|OpenImageIO|Imf|Q[A-Z]",
    "Web": r"vtk|OpenImageIO|Imf|gdal|ogr|Q[A-Z]",
    "Web/wasm": r"vtk|OpenImageIO|Imf|gdal|ogr|Q[A-Z]|fstream|cstdio",
    "ParaView": r"vtk|OpenImageIO|Imf|gdal|ogr|Q[A-Z]",
    "ParaView/Adapters": r"vtk_gl|OpenImageIO|Imf|gdal|ogr|Q[A-Z]|fstream",
    "Programs/reliefshade": r"vtkOpenGL|vtk_gl|Q[A-Z]",
}
INCLUDE = re.compile(r'^\s*#\s*include\s+[<"]([^>"]+)[>"]', re.MULTILINE)
# Their encoded texts become headers when they are built.
SUFFIXES = {".h", ".cxx", ".glsl"}


def room_of(path):
    """The innermost room that a file lies in."""
    folder = path.parent.as_posix()
    fits = [room for room in MAY_INCLUDE if folder == room or folder.startswith(room + "/")]
    return max(fits, key=len) if fits else None


def read_includes(folder):
    """For each file its room, and the names that it includes."""
    result = {}
    for path in sorted(folder.rglob("*")):
        relative = path.relative_to(folder)
        if path.suffix in SUFFIXES and relative.parts[0] != "Python":
            result[relative] = INCLUDE.findall(path.read_text(encoding="utf-8"))
    return result


def named(stem, page):
    """Whether a page has the name, as a word of its own; sections of the panel share a row."""
    return re.search(rf"\b{re.escape(stem)}\b", page) or stem.endswith(("Section", "Sections"))


def find_circle(arrows):
    """A circle among files as a list of names; empty where there is none."""
    done, way = set(), []

    def visit(file):
        if file in way:
            return way[way.index(file):] + [file]
        if file not in done:
            way.append(file)
            for target in sorted(arrows.get(file, ())):
                circle = visit(target)
                if circle:
                    return circle
            way.pop()
            done.add(file)
        return []

    for file in sorted(arrows):
        circle = visit(file)
        if circle:
            return circle
    return []


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    includes = read_includes(folder)
    wrong = [f"{file} lies in no room" for file in includes if room_of(file) is None]
    headers = {}
    for file in includes:
        if file.suffix in {".h", ".glsl"} and room_of(file):
            headers.setdefault(file.name, []).append(file)
    wrong += [f"{name} is the name of {len(files)} headers: {', '.join(map(str, files))}"
              for name, files in headers.items() if len(files) > 1]

    arrows, count = {}, 0
    for file, names in includes.items():
        room = room_of(file)
        for name in names:
            if room in NEVER and re.match(NEVER[room], name) and name not in headers:
                wrong.append(f"{file} includes {name}, which {room} may not know")
            for target in headers.get(pathlib.PurePath(name).name, []):
                count += 1
                other = room_of(target)
                if other != room and other not in MAY_INCLUDE[room]:
                    wrong.append(f"{file} includes {target}: {room} may not know {other}")
                if target != file and target.suffix == ".h" and file.suffix == ".h":
                    arrows.setdefault(str(file), set()).add(str(target))
    circle = find_circle(arrows)
    if circle:
        wrong.append("headers include each other in a circle: " + " -> ".join(circle))
    page = (folder.parent / "Documentation/Architecture.md").read_text(encoding="utf-8")
    wrong += [f"Documentation/Architecture.md does not name {file.stem} ({room_of(file)})"
              for file in includes if file.suffix == ".h" and not named(file.stem, page)]
    if count < 100:
        wrong.append(f"only {count} includes were found between files: is the folder right?")
    print(f"{len(includes)} files, {count} includes between them")
    for line in wrong:
        print(line)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
