# SPDX-License-Identifier: BSD-3-Clause
"""The keywords of shade(): those that are written here, and one for each parameter of the table."""

import difflib
import inspect
import math
import numbers
import operator
import os
import re
import reprlib

from . import parameters
from ._errors import listening

# What is no parameter of the table: name, default, unit and what help tells.
FIXED = (
    ("spacing", 1.0, "length", "Distance of the samples, a number or (dx, dy), each from 1e-32 to 1e32"),
    ("mask", None, "", "Array of the heights' shape: where it is 0 or False there is no data"),
    ("nodata", None, "heights", "The height that marks samples without data"),
    ("sun", None, "degrees", "(azimuth, altitude[, angular diameter]), any azimuth, an altitude from "
     "-90 to 90, a diameter from 0 to 90; a dict of these with color, intensity and on, or a vtkLight. "
     "Without any light: (315, 45) with intensity 0.95"),
    ("suns", None, "degrees", "Several such suns"),
    ("sun_at", None, "degrees", "(time, longitude, latitude[, convergence]): the sun of a moment, an "
     "aware datetime or text of ISO 8601 with its zone; longitude from -180 to 360, latitude from -90 to 90; "
     "or a dict with elevation (metres) and refraction, too"),
    ("lamp", None, "length", "(x, y, z), finite, from the lower left sample, x to the right and y up the "
     "array, a dict with position, color, intensity and on, or a vtkLight"),
    ("lamps", None, "length", "Several such lamps"),
    ("preset", None, "", "Lights that map makers know: default, multidirectional, sky-dome, "
     "sun-and-sky, combined or igor; the last three go by sun"),
    ("environment", None, "", "Light from all around: an array of (rows, columns[, 1 to 4]), zenith on "
     "top, of the types of diffuse_texture, or a vtkReliefEnvironment"),
    ("depth", None, "spacing", 'subsurface_depth by its short name, a number of at least 0, or "auto"'),
    ("diffuse_texture", None, "", "Array of (rows, columns[, 1 to 4]) over the diffuse colour: "
     "uint8 and uint16 are sRGB-encoded, float32 and float64 linear; it is stretched over the relief"),
    ("base_texture", None, "", "The same over the base colour"),
    ("specular_texture", None, "", "The same over the specular colour"),
    ("cmap", None, "", "Diffuse colour by height: a name or colormap of Matplotlib, an array of "
     "colours, pairs of (height, colour), or a vtkScalarsToColors"),
    ("clim", None, "heights", "Heights of the colormap's ends, (low, high), low below high; usually the "
     "least and the greatest"),
    ("layers", (), "", "Further results: illumination, thickness, shadow, normals, base, diffuse, "
     'scatter, specular, or "all" (which leaves out shadow where there is no sun)'),
    ("dtype", "uint8", "", "uint8, sRGB-encoded, or float32, linear and neither exposed nor clamped"),
    ("alpha", True, "", "Whether there is a fourth component, which is 0 where there is no data"),
    ("background", (0.0, 0.0, 0.0), "linear RGB", "Colour where there is no data, each component from 0 to "
     "1, of alpha=False and of files that know no alpha"),
    ("scene", None, "", "A vtkReliefScene, or the name of a scene file, to begin with; it is left alone"),
)
LAYERS = ("illumination", "thickness", "shadow", "normals", "base", "diffuse", "scatter", "specular")
FIXED_NAMES = tuple(row[0] for row in FIXED)
# What the table has as a number and people want found for them.
AUTOMATIC = ("height_scale", "exposure")
# What a keyword does to another that is not given.
TURNS = {"subsurface_depth": "turns automatic_subsurface_depth off", "floor_height": "turns use_floor on"}
# Heights are read once; all others may change from picture to picture.
OF_HEIGHTS = ("spacing", "mask", "nodata")


def snake(name):
    return re.sub(r"(?<=.)([A-Z])", r"_\1", name).lower()


def _table():
    rows = {}
    for row in parameters():
        if row["owner"] != "Light":
            prefix = "environment_" if row["owner"] == "Environment" else ""
            rows[prefix + snake(row["name"])] = row
    return rows


TABLE = _table()
OF_LIGHT = {snake(row["key"]): row for row in parameters() if row["owner"] == "Light"}


# ------------------------------------------------------------------------------
# Values of keywords.

ROOM = 60  # of a value in a message, in characters


def brief(text, room=ROOM):
    """A text of one line that leaves out what is in its middle where it is long."""
    text = " ".join(text.split()) if "\n" in text else text
    return text if len(text) <= room else f"{text[:(room - 3) // 2]}...{text[-(room - 2) // 2:]}"


class _Shown(reprlib.Repr):
    """Python's own repr() of values that may have any length, and fail."""

    def __init__(self):
        super().__init__()
        self.maxlevel, self.maxstring, self.maxother, self.maxlong = 3, ROOM, ROOM, ROOM

    def repr_int(self, value, level):
        # Python refuses to write thousands of digits.
        if value.bit_length() > 999:
            return f"an integer of {value.bit_length()} bits"
        return super().repr_int(value, level)


def shown(value):
    """A value as messages show it."""
    try:
        return brief(_Shown().repr(value))
    except Exception:  # whatever it is that cannot be shown
        return f"<{type(value).__name__}>"


def suggestion(word, words):
    if not isinstance(word, str) or len(word) > ROOM:
        return ""
    near = difflib.get_close_matches(word.lower(), words, 1)
    return f"; did you mean {near[0]!r}?" if near else ""


# What others call it.
ELSEWHERE = {
    "azimuth": "sun", "azdeg": "sun", "altitude": "sun", "altdeg": "sun", "angle": "sun", "time": "sun_at",
    "light": "lamp", "lights": "suns", "ambient": "base_color", "color": "diffuse_color",
    "tint": "cmap", "colormap": "cmap", "vmin": "clim", "vmax": "clim", "texture": "diffuse_texture",
    "z_factor": "height_scale", "zfactor": "height_scale", "vert_exag": "height_scale",
    "scale": "height_scale", "exaggeration": "height_scale", "dx": "spacing", "dy": "spacing",
    "resolution": "spacing", "cellsize": "spacing", "nodata_value": "nodata", "no_data": "nodata",
    "brightness": "exposure", "steps": "number_of_steps", "offset": "offset_mode", "floor": "floor_height"}


def kept(keywords):
    """Keywords that can be used again: an iterator, which can be read but once, becomes a tuple, and a
    scene's file its scene."""
    again = {name: tuple(value) if hasattr(value, "__next__") else value
             for name, value in keywords.items()}
    if isinstance(again.get("scene"), (str, bytes, os.PathLike)):
        from ._scene_file import read_scene
        try:
            again["scene"] = read_scene(again["scene"])
        except (OSError, ValueError) as error:
            raise type(error)(f"scene: {error}") from None
    return again


def check_names(function, keywords, without=()):
    known = [name for name in (*FIXED_NAMES, *TABLE) if name not in without]
    for name in keywords:
        if name not in known:
            other = ELSEWHERE.get(name.lower())
            raise TypeError(f"{function}() got an unexpected keyword argument {shown(name)}"
                            + (f"; did you mean {other!r}?" if other in known
                               else suggestion(name, known)))


def is_flag(value):
    return isinstance(value, bool) or getattr(getattr(value, "dtype", None), "kind", "") == "b"


def flag(value, name):
    if not is_flag(value):
        raise TypeError(f"{name}: True or False is expected, not {shown(value)}")
    return bool(value)


class _TooLarge(ValueError):
    """A number that a float or an int of C cannot hold."""


def number(value, name, expected="a number"):
    """A float of a real number, which neither a bool nor a text is."""
    if isinstance(value, (str, bytes)) or is_flag(value):
        raise TypeError(f"{name}: {expected} is expected, not {shown(value)}")
    if not isinstance(value, numbers.Real) and getattr(value, "ndim", None) != 0:
        raise TypeError(f"{name}: {expected} is expected, not {type(value).__name__}")
    try:
        return float(value)
    except OverflowError:
        raise _TooLarge(f"{name}: {shown(value)} was given, {expected} is expected") from None
    except (TypeError, ValueError):
        raise TypeError(f"{name}: {expected} is expected, not {shown(value)}") from None


def several(value, name, counts, expected):
    """Floats, of which there must be one of several counts."""
    try:
        items = list(value) if not isinstance(value, (str, bytes, dict)) else None
    except TypeError:
        items = None
    if items is None or len(items) not in counts:
        raise TypeError(f"{name}: {expected} is expected, not {shown(value)}")
    return tuple(number(item, name, expected) for item in items)


def _decoded(code):
    return code / 12.92 if code <= 0.04045 else ((code + 0.055) / 1.055) ** 2.4


def color(value, name):
    """Linear RGB of three numbers, of one for grey, or of a name as CSS has it, "#rrggbb" too."""
    if isinstance(value, str):
        return tuple(_decoded(code) for code in encoded_color(value, name))
    if getattr(value, "ndim", 0) == 0 and isinstance(value, numbers.Real):
        return (number(value, name),) * 3
    return several(value, name, (3,), "a colour, three numbers or a name,")


def encoded_color(text, name):
    """The sRGB codes, 0 to 1, of a colour's name."""
    from vtkmodules.vtkCommonColor import vtkNamedColors
    colors = vtkNamedColors()
    if re.fullmatch(r"#([0-9a-fA-F]{3}|[0-9a-fA-F]{6})", text):
        digits = text[1:] if len(text) == 7 else "".join(2 * digit for digit in text[1:])
        return tuple(int(digits[i:i + 2], 16) / 255.0 for i in (0, 2, 4))
    if not colors.ColorExists(text):
        raise ValueError(f"{name}: {shown(text)} is no colour; a name as of CSS or #rrggbb is expected")
    codes = colors.GetColor4ub(text)
    return tuple(codes[i] / 255.0 for i in range(3))


def word_of(choice):
    """A choice's name as it is typed: FixedStep is fixed-step."""
    return snake(choice).replace("_", "-")


def _choice(value, name, choices):
    words = [word_of(choice) for choice in choices]
    if not isinstance(value, str):
        raise TypeError(f"{name}: one of {', '.join(words)} is expected, not {shown(value)}")
    for i, choice in enumerate(choices):
        if value in (choice, words[i], words[i].replace("-", "_")):
            return i
    raise ValueError(f"{name}: {shown(value)} was given, one of {', '.join(words)} is expected"
                     + suggestion(value, words))


def converted(row, value, name):
    """The arguments of a parameter's setter."""
    try:
        return _converted(row, value, name)
    except _TooLarge:
        raise ValueError(f"{name}: {shown(value)} was given, {_bounds(row)} is expected") from None


def _converted(row, value, name):
    kind = row["kind"]
    if kind == "choice":
        return (_choice(value, name, row["choices"]),)
    if kind == "flag":
        return (flag(value, name),)
    if kind == "count":
        try:
            if is_flag(value):
                raise TypeError
            value = operator.index(value)
            if not -2 ** 31 <= value < 2 ** 31:
                raise _TooLarge
            return (value,)
        except TypeError:
            raise TypeError(f"{name}: a whole number is expected, not {shown(value)}") from None
    if kind == "color":
        return color(value, name)
    if kind == "range":
        return several(value, name, (2,), "a pair of numbers")
    if kind == "length" and isinstance(value, str) and value == "infinite":
        return (math.inf,)
    return (number(value, name),)


def set_checked(name, instance, setter, arguments, *others):
    """Calls a setter, by name or a function; what it refuses is a ValueError with its own message."""
    with listening(instance, *others) as heard:
        try:
            result = (setter if callable(setter) else getattr(instance, setter))(*arguments)
        except OverflowError as error:
            raise ValueError(f"{name}: {brief(str(error), 120)}") from None
    if heard.failed:
        # The setter's own words, but for its name and for what becomes of its object.
        text = re.sub(r"\A[A-Z]\w+: ", "", heard.errors[0])
        text = re.sub(r"; [^;]* (kept|added|changed)\Z", "", text.rstrip("."))
        if "not enough memory" in text:
            raise MemoryError(text)
        raise ValueError(f"{name}: {brief(text, 160)}")
    return result


# ------------------------------------------------------------------------------
# What help() and inspect tell.

def default_of(row):
    return word_of(row["default"]) if row["kind"] == "choice" else row["default"]


def signature(first, without=()):
    Parameter = inspect.Parameter
    keywords = [(name, default) for name, default, _, _ in FIXED]
    keywords += [(name, default_of(row)) for name, row in TABLE.items()]
    return inspect.Signature([
        *[Parameter(name, Parameter.POSITIONAL_OR_KEYWORD) for name in first],
        *[Parameter(name, Parameter.KEYWORD_ONLY, default=default)
          for name, default in keywords if name not in without]])


def _bounds(row):
    low, high = row["minimum"], row["maximum"]
    if row["kind"] == "choice":
        return "one of " + ", ".join(word_of(choice) for choice in row["choices"])
    if row["kind"] == "flag":
        return "True or False"
    what = {"count": "a whole number", "color": "linear RGB, a name or a grey, each component",
            "range": "a pair, the first not the larger"}.get(row["kind"], "a number")
    if math.isfinite(low) and math.isfinite(high):
        return f"{what} from {low:.9g} to {high:.9g}"
    if math.isfinite(low):
        return what + (" above " if row["minimum_open"] else " of at least ") + f"{low:.9g}"
    return what


def _paragraph(name, facts, text):
    import textwrap
    facts = "; ".join(fact for fact in facts if fact)
    return f"{name}: {facts}\n" + textwrap.fill(text + ".", 96, initial_indent="    ",
                                                subsequent_indent="    ")


def described(without=()):
    """A paragraph for each keyword."""
    lines = []
    for name, default, unit, text in FIXED:
        if name not in without:
            lines.append(_paragraph(name, (unit, f"default {default!r}"), text))
    for name, row in TABLE.items():
        if name not in without:
            taken = _bounds(row) + (', or "auto"' if name in AUTOMATIC else "") + (
                ', or "infinite"' if row["kind"] == "length" else "")
            lines.append(_paragraph(name, (
                row["unit"], taken, f"default {default_of(row)!r}", TURNS.get(name)), row["help"]))
    return "\n".join(lines)
