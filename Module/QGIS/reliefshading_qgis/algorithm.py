# SPDX-License-Identifier: BSD-3-Clause
"""The algorithm "Relief shading". What parameters a scene has is the program's to say."""

import shlex

from qgis.core import (
    QgsContrastEnhancement, QgsMultiBandColorRenderer, QgsProcessingAlgorithm,
    QgsProcessingException, QgsProcessingLayerPostProcessorInterface, QgsProcessingParameterBand,
    QgsProcessingParameterBoolean, QgsProcessingParameterColor, QgsProcessingParameterDefinition,
    QgsProcessingParameterEnum, QgsProcessingParameterNumber,
    QgsProcessingParameterRange, QgsProcessingParameterRasterDestination,
    QgsProcessingParameterRasterLayer, QgsProcessingParameterString, QgsProviderRegistry,
    QgsSingleBandGrayRenderer)
from qgis.PyQt.QtGui import QPainter

from . import program

# Where light comes from, and what the program calls it.
LIGHTS = ("One sun", "Four suns (multidirectional)", "Sky dome", "Sun and sky",
          "Combined with slope", "Slope and aspect (Igor)")
NAMED_BY_GROUP = ("backlight", "environment", "highlights")
# Presets of lights have their own.
OF_LIGHTS = ("environment", "lights")
ADVANCED = ("accuracy", "backlight", "environment")


def linear(code):
    """An 8-bit code of sRGB as the linear number that the program takes (IEC 61966-2-1)."""
    encoded = code / 255.0
    return encoded / 12.92 if encoded <= 0.04045 else ((encoded + 0.055) / 1.055) ** 2.4


def definitionOf(entry):
    """The parameter of QGIS for one of the program's. Without a value it is the program's own
    default."""
    name, kind = nameOf(entry), entry["kind"]
    label = entry["label"]
    if entry["group"] in NAMED_BY_GROUP:
        label = f"{entry['group'].capitalize()}: {label[0].lower()}{label[1:]}"
    # Lengths are metres on the map; their help says so.
    label += " (degrees)" if entry["unit"] == "degrees" else ""
    if kind == "choice":
        definition = QgsProcessingParameterEnum(
            name, label, options=entry["choices"], optional=True)
    elif kind == "color":
        definition = QgsProcessingParameterColor(name, label, opacityEnabled=False, optional=True)
    elif kind == "range":
        definition = QgsProcessingParameterRange(
            name, label, type=QgsProcessingParameterNumber.Double, optional=True)
    else:
        whole = kind == "count"
        definition = QgsProcessingParameterNumber(
            name, label, optional=True,
            type=QgsProcessingParameterNumber.Integer if whole else QgsProcessingParameterNumber.Double)
        if entry["minimum"] is not None:
            definition.setMinimum(entry["minimum"])
        if entry["maximum"] is not None:
            definition.setMaximum(entry["maximum"])
    definition.setHelp(f"{entry['help']}. Left empty: {usual(entry)}.")
    if entry["group"] in ADVANCED:
        definition.setFlags(definition.flags() | QgsProcessingParameterDefinition.FlagAdvanced)
    return definition


def usual(entry):
    """What the program takes where nothing is given."""
    if entry["auto"]:
        return "chosen automatically"
    if entry["offUntilGiven"]:
        return "none"
    told = entry["choices"][int(entry["default"][0])] if entry["choices"] else ", ".join(
        "infinite" if number is None else f"{number:g}" for number in entry["default"])
    return told + (", or what the light brings" if entry["group"] in OF_LIGHTS else "")


def nameOf(entry):
    """The option without its hyphens, as QGIS names parameters."""
    return entry["option"].lstrip("-").replace("-", "_").upper()


class Style(QgsProcessingLayerPostProcessorInterface):
    """Shows the picture as it is: without stretching, transparent where it is; and if wanted,
    multiplied with what lies below."""

    kept = []  # as long as QGIS may call them

    def __init__(self, multiply):
        super().__init__()
        self.multiply = multiply
        Style.kept.append(self)

    def postProcessLayer(self, layer, context, feedback):
        style(layer, self.multiply)
        layer.triggerRepaint()


def style(layer, multiply):
    provider = layer.dataProvider()
    bands = layer.bandCount()
    if bands >= 3:
        renderer = QgsMultiBandColorRenderer(provider, 1, 2, 3)
    else:
        renderer = QgsSingleBandGrayRenderer(provider, 1)
        plain = QgsContrastEnhancement(provider.dataType(1))
        plain.setContrastEnhancementAlgorithm(QgsContrastEnhancement.NoEnhancement)
        renderer.setContrastEnhancement(plain)
    if bands in (2, 4):
        renderer.setAlphaBand(bands)
    layer.setRenderer(renderer)
    layer.setBlendMode(QPainter.CompositionMode_Multiply if multiply
                       else QPainter.CompositionMode_SourceOver)


class Shading(QgsProcessingAlgorithm):
    INPUT, BAND, LIGHT, AZIMUTH, ALTITUDE = "INPUT", "BAND", "LIGHT", "AZIMUTH", "ALTITUDE"
    TIME, TEXTURE, EXTRA, MULTIPLY = "TIME", "TEXTURE", "EXTRA", "MULTIPLY"
    OUTPUT, SHADOW = "OUTPUT", "SHADOW"

    def createInstance(self):
        return Shading()

    def name(self):
        return "shade"

    def displayName(self):
        return "Relief shading"

    def group(self):
        return "Raster terrain analysis"

    def groupId(self):
        return "terrain"

    def tags(self):
        return ["hillshade", "shadow", "relief", "sky", "dem", "light"]

    def shortHelpString(self):
        return (
            "Shades elevation with direct light, soft shadows that the relief throws, and light "
            "from the sky. What is left empty is chosen by the program reliefshade, which does "
            "the work.\n\nThe picture has the raster's georeference and is shown as it is, not "
            "stretched. Multiply it with the layers below to shade a map.")

    def canExecute(self):
        try:
            program.parameters()
        except program.Failure as failure:
            return False, str(failure)
        return True, ""

    def initAlgorithm(self, config=None):
        add = self.addParameter
        add(QgsProcessingParameterRasterLayer(self.INPUT, "Elevation"))
        add(QgsProcessingParameterBand(self.BAND, "Band", 1, self.INPUT, optional=True))
        add(QgsProcessingParameterEnum(self.LIGHT, "Light", options=list(LIGHTS), defaultValue=0))
        add(QgsProcessingParameterNumber(
            self.AZIMUTH, "Azimuth of the sun (degrees from north)",
            QgsProcessingParameterNumber.Double, 315.0))
        add(QgsProcessingParameterNumber(
            self.ALTITUDE, "Altitude of the sun (degrees)", QgsProcessingParameterNumber.Double,
            45.0, minValue=-90.0, maxValue=90.0))
        time = QgsProcessingParameterString(
            self.TIME, "Sun of a time, in place of its angles (2026-06-21T06:30+02:00)",
            optional=True)
        time.setHelp("ISO 8601 with a zone. The place is the raster's centre.")
        add(time)
        for entry in self.table():
            add(definitionOf(entry))
        add(QgsProcessingParameterRasterLayer(
            self.TEXTURE, "Picture as colors, such as an orthophoto", optional=True))
        extra = QgsProcessingParameterString(
            self.EXTRA, "More options of reliefshade, as typed (--point X,Y,Z)", optional=True)
        extra.setFlags(extra.flags() | QgsProcessingParameterDefinition.FlagAdvanced)
        add(extra)
        add(QgsProcessingParameterBoolean(
            self.MULTIPLY, "Multiply with the layers below", defaultValue=False))
        add(QgsProcessingParameterRasterDestination(self.OUTPUT, "Shaded relief"))
        add(QgsProcessingParameterRasterDestination(
            self.SHADOW, "Shadow of the sun (0 to 255)", optional=True, createByDefault=False))

    def table(self):
        try:
            return program.parameters()
        except program.Failure:
            return []  # which canExecute() tells

    def sourceOf(self, parameters, name, context):
        layer = self.parameterAsRasterLayer(parameters, name, context)
        if layer is None:
            if parameters.get(name):
                raise QgsProcessingException(self.invalidRasterError(parameters, name))
            return None
        if layer.providerType() != "gdal":
            raise QgsProcessingException(
                f"'{layer.name()}' is a layer of the provider {layer.providerType()}, a raster file "
                "is expected; export it as a GeoTIFF first")
        # What QGIS adds to a file's name is its own; subdatasets have names of GDAL's.
        parts = QgsProviderRegistry.instance().decodeUri("gdal", layer.source())
        return layer.source() if parts.get("layerName") else parts.get("path") or layer.source()

    def lightWords(self, parameters, context):
        light = self.parameterAsEnum(parameters, self.LIGHT, context)
        sun = "{:.12g},{:.12g}".format(
            self.parameterAsDouble(parameters, self.AZIMUTH, context),
            self.parameterAsDouble(parameters, self.ALTITUDE, context))
        time = self.parameterAsString(parameters, self.TIME, context).strip()
        if light == 0:
            return ["--sun-at", time] if time else ["--sun", sun]
        if time:
            raise QgsProcessingException(
                f"a time was given with the light '{LIGHTS[light]}'; it is that of 'One sun'")
        return ["--preset", ("", "multidirectional", "sky-dome", "sun-and-sky," + sun, "combined," + sun,
                             "igor," + sun.split(",")[0])[light]]

    def valueWord(self, entry, parameters, context):
        """The value of a parameter as the program takes it; None for its default."""
        name, kind = nameOf(entry), entry["kind"]
        given = parameters.get(name)
        if given is None or given == "":
            return None
        if kind == "choice":
            return entry["choices"][self.parameterAsEnum(parameters, name, context)]
        if kind == "color":
            color = self.parameterAsColor(parameters, name, context)
            if not color.isValid():
                return None
            return ",".join(
                f"{linear(code):.9g}" for code in (color.red(), color.green(), color.blue()))
        if kind == "range":
            return ",".join(f"{end:.12g}" for end in self.parameterAsRange(parameters, name, context))
        if kind == "count":
            return str(self.parameterAsInt(parameters, name, context))
        return f"{self.parameterAsDouble(parameters, name, context):.12g}"

    def words(self, parameters, context):
        """The program's command line."""
        words = [self.sourceOf(parameters, self.INPUT, context),
                 self.parameterAsOutputLayer(parameters, self.OUTPUT, context)]
        band = self.parameterAsInt(parameters, self.BAND, context)
        words += ["--band", str(band)] if band > 1 else []
        words += self.lightWords(parameters, context)
        for entry in program.parameters():
            value = self.valueWord(entry, parameters, context)
            words += [f"{entry['option']}={value}"] if value is not None else []
        texture = self.sourceOf(parameters, self.TEXTURE, context)
        words += ["--texture", texture] if texture else []
        shadow = self.parameterAsOutputLayer(parameters, self.SHADOW, context)
        words += ["--shadow-mask", shadow] if shadow else []
        try:
            words += shlex.split(self.parameterAsString(parameters, self.EXTRA, context))
        except ValueError as error:
            raise QgsProcessingException(f"More options: {error}; quotes come in pairs") from error
        return words

    def processAlgorithm(self, parameters, context, feedback):
        try:
            done = program.run(self.words(parameters, context), feedback)
        except program.Failure as failure:
            raise QgsProcessingException(str(failure)) from failure
        if not done:
            return {}
        results = {self.OUTPUT: self.parameterAsOutputLayer(parameters, self.OUTPUT, context)}
        multiply = self.parameterAsBoolean(parameters, self.MULTIPLY, context)
        if context.willLoadLayerOnCompletion(results[self.OUTPUT]):
            context.layerToLoadOnCompletionDetails(results[self.OUTPUT]).setPostProcessor(
                Style(multiply))
        shadow = self.parameterAsOutputLayer(parameters, self.SHADOW, context)
        if shadow:
            results[self.SHADOW] = shadow
        return results
