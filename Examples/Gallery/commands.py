# SPDX-License-Identifier: BSD-3-Clause
"""The gallery's pictures that are one command each: a cartographer's and a sculptor's."""

import shutil

TINT = """# height red green blue
250 96 138 92
350 164 178 112
500 214 200 140
700 196 164 116
950 240 236 228
"""


class Page:
    def __init__(self, title, about, pictures):
        self.title, self.about, self.pictures = title, about, pictures


def prepare(folder, terrain):
    """What the commands read, beside the sculptures."""
    shutil.copy(terrain, folder / "jacksboro.tif")
    (folder / "tint.txt").write_text(TINT, encoding="utf-8")


def of_terrain(name, label, *words):
    return name, label, ["jacksboro.tif", name + ".png", "--height-scale", "2", *words]


def of_owl(name, label, *words):
    return name, label, ["owl.ply", name + ".png", "--resolution", "480", *words]


PAGES = [
    Page("The cartographer's page",
         "Mountains in Tennessee, `Examples/Data/jacksboro.tif`, twice as steep as they are. Each picture is one command.",
         [of_terrain("map-sun", "One sun"),
          of_terrain("map-low-sun", "A low sun, soft shadows", "--sun", "315,20", "--sun-diameter", "3", "--depth", "150"),
          of_terrain("map-multidirectional", "Four suns", "--preset", "multidirectional"),
          of_terrain("map-combined", "Light and slope", "--preset", "combined"),
          of_terrain("map-sky", "The sky alone", "--preset", "sky-dome"),
          of_terrain("map-sun-and-sky", "The sun and a clear sky", "--preset", "sun-and-sky,300,20"),
          of_terrain("map-tint", "Tints by height, in the light of four suns", "--tint", "tint.txt", "--preset",
                     "multidirectional", "--exposure", "0.6")]),
    Page("The sculptor's page",
         "One mesh, an owl in full round, `owl.ply` as `carve owl 280 owl.ply` makes it.",
         [of_owl("owl-raw", "Its depth as it is: too deep for a relief", "--sun", "300,35"),
          of_owl("owl-relief", "Squeezed to 5 % of its depth", "--relief", "0.05", "--sun", "300,35"),
          of_owl("owl-coin", "Struck in bronze, 3 %", "--relief", "0.03", "--base", "0.02,0.01,0", "--diffuse",
                 "0.55,0.3,0.1", "--specular", "1,0.72,0.35", "--ks", "0.55", "--specular-power", "5", "--sun",
                 "300,40", "--sun", "120,25,0.3"),
          of_owl("owl-cameo", "A cameo of alabaster, a lamp behind it", "--relief", "0.12", "--floor", "-0.02",
                 "--attenuation", "exponential", "--density", "45", "--depth", "0.02", "--kf", "0.5", "--diffuse",
                 "1,0.6,0.3", "--point", "1,1.4,-0.5", "--sun", "300,40,0.05", "--exposure", "auto")]),
]
