// SPDX-License-Identifier: BSD-3-Clause
//
// Which part of the relief is seen. Places on the relief are shares of it, from the left and from the top; places
// in the room for the picture are pixels.

const largestSample = 32; // pixels
const least = 1; // the whole relief in the room
const nothing = 1e-9;

export class View {
  /** @param onChange   called when another part is seen */
  constructor(onChange) {
    this.onChange = onChange;
    this.room = [1, 1];
    this.extent = [1, 1];
    this.zoom = 1;
    this.center = [0.5, 0.5];
  }

  /** Another relief is seen as a whole. */
  setField({ width, height, spacing }) {
    this.extent = [width * spacing[0], height * spacing[1]];
    this.spacing = Math.min(...spacing);
    this.zoom = 1;
    this.center = [0.5, 0.5];
  }

  setRoom(width, height) {
    this.room = [Math.max(width, 1), Math.max(height, 1)];
    this.goTo(this.zoom, this.center);
  }

  /** Pixels for a length on the relief. */
  get scale() {
    return this.zoom * Math.min(...this.room.map((length, k) => length / this.extent[k]));
  }

  /** The whole relief, in pixels. */
  get size() {
    return this.extent.map((length) => length * this.scale);
  }

  get isWhole() {
    return this.zoom <= least;
  }

  get isLargest() {
    return this.zoom >= this.largest;
  }

  get largest() {
    const whole = Math.min(...this.room.map((length, k) => length / this.extent[k]));
    return Math.max(largestSample / (whole * this.spacing), 4);
  }

  toPixels(place) {
    return place.map((c, k) => this.room[k] / 2 + (c - this.center[k]) * this.size[k]);
  }

  toShare(pixels) {
    return pixels.map((c, k) => this.center[k] + (c - this.room[k] / 2) / this.size[k]);
  }

  // No empty margin where the relief is larger than the room, and even ones where it is not.
  goTo(zoom, center) {
    this.zoom = Math.min(Math.max(zoom, least), this.largest);
    const { size, room } = this;
    this.center = center.map((c, k) => {
      const half = room[k] / size[k] / 2;
      return half >= 0.5 - nothing ? 0.5 : Math.min(Math.max(c, half), 1 - half);
    });
  }

  /** Larger by a factor; the place under `at`, pixels, stays there. */
  zoomBy(factor, at = this.room.map((length) => length / 2)) {
    const place = this.toShare(at);
    const zoom = Math.min(Math.max(this.zoom * factor, least), this.largest);
    const size = this.size.map((length) => (length * zoom) / this.zoom);
    this.goTo(
      zoom,
      place.map((c, k) => c - (at[k] - this.room[k] / 2) / size[k]),
    );
    this.onChange();
  }

  /** The relief moved by pixels. */
  panBy(pixels) {
    const { size } = this;
    this.goTo(
      this.zoom,
      this.center.map((c, k) => c - pixels[k] / size[k]),
    );
    this.onChange();
  }

  fit() {
    this.goTo(1, [0.5, 0.5]);
    this.onChange();
  }
}
