// SPDX-License-Identifier: BSD-3-Clause
//
// The part of the panel that chooses how the file of heights is read.

import { section, select, slider, text } from "./controls.js";

const mostSamples = 8192; // along the longer side

const sides = [
  ["0,0,1", "+z"],
  ["0,0,-1", "−z"],
  ["0,-1,0", "−y"],
  ["0,1,0", "+y"],
  ["1,0,0", "+x"],
  ["-1,0,0", "−x"],
];

/** Three numbers, not all of them 0; null for other texts. */
function vectorOf(words) {
  const numbers = words.split(",").map((word) => (word.trim() === "" ? NaN : Number(word)));
  return numbers.length === 3 && numbers.every(Number.isFinite) && numbers.some((c) => c !== 0)
    ? numbers
    : null;
}

/** @param page   field, and rereadHeights(values) */
export function heightsSection(page, shows) {
  const how = () => page.field.source.how;
  const change = (values) => page.rereadHeights(values);
  const vector = (key, label, title) =>
    text({
      label,
      title,
      onChange: (words) => {
        const numbers = vectorOf(words);
        if (numbers) {
          change({ [key]: numbers });
        } else {
          page.alert(`${label}: “${words}” was given, three numbers that are not all 0 are expected.`);
        }
      },
    });
  const side = select({
    label: "Seen from",
    title: "The side from which the mesh is seen, by its own axes",
    options: [...sides, ["", "Elsewhere"]],
    onChange: (words) => words && change({ direction: vectorOf(words) }),
  });
  const direction = vector(
    "direction",
    "Direction",
    "From the mesh toward the eye, x, y and z in the mesh's own axes; reliefshade --view",
  );
  const up = vector("up", "Up", "What of the mesh points up in the picture; reliefshade --view-up");
  let wanted = 0; // while the slider is held
  const resolution = slider({
    label: "Resolution",
    title: "How many samples the mesh has along its longer side; reliefshade --resolution. Default: 1024.",
    range: [64, 4096, 2],
    low: 1,
    high: mostSamples,
    whole: true,
    onInput: (value) => {
      wanted = value;
      resolution.show(value);
    },
    onEnd: () => {
      if (wanted > 0 && wanted !== how().resolution) {
        change({ resolution: wanted });
      }
      wanted = 0;
    },
  });
  const as = select({
    label: "Read as",
    title: "What the colours of the picture stand for; reliefshade --normal-map, --encoding",
    options: [
      ["brightness", "Heights, by brightness"],
      ["normals", "Normals"],
      ["terrarium", "Heights as in Terrarium's tiles"],
      ["terrain-rgb", "Heights as in Mapbox's tiles"],
    ],
    onChange: (value) => change({ as: value }),
  });
  const green = select({
    label: "Green",
    title: "Where green points; reliefshade --normal-map",
    options: [
      ["auto", "What suits the picture"],
      ["up", "Up (OpenGL)"],
      ["down", "Down (DirectX)"],
    ],
    onChange: (value) => change({ green: value }),
  });
  const method = select({
    label: "Method",
    title: "How normals become heights; reliefshade --normal-method",
    options: [
      ["least-squares", "Smoothly"],
      ["cliffs", "With cliffs"],
      ["path-sums", "By sums along paths"],
    ],
    onChange: (value) => change({ method: value }),
  });
  const ofMesh = [side, direction, up, resolution];
  const ofNormals = [green, method];
  const element = section("Heights", ...[...ofMesh, as, ...ofNormals].map((control) => control.element));
  shows.push(() => {
    const { source } = page.field;
    element.hidden = !source;
    if (!source) {
      return;
    }
    const mesh = source.kind === "mesh";
    ofMesh.forEach((control) => (control.element.hidden = !mesh));
    as.element.hidden = mesh;
    ofNormals.forEach((control) => (control.element.hidden = how().as !== "normals"));
    if (mesh) {
      const words = how().direction.join(",");
      side.show(sides.some(([value]) => value === words) ? words : "");
      direction.show(how().direction.join(", "));
      up.show(how().up.join(", "));
      resolution.show(how().resolution);
    } else {
      as.show(how().as);
      green.show(how().green);
      method.show(how().method);
    }
  });
  return element;
}
