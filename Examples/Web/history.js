// SPDX-License-Identifier: BSD-3-Clause
//
// The state of the page, and the states before it. A state is never changed, only replaced.

const most = 200; // steps that can be taken back

export class History {
  constructor(onChange) {
    this.onChange = onChange;
    this.begin({});
  }

  /** Another document: nothing before it can be reached. */
  begin(state) {
    this.past = [];
    this.future = [];
    this.state = state;
    this.gesture = null;
  }

  /** Changes of one gesture, as those of a slider that is dragged, are one step until it ends. */
  change(state, gesture = null) {
    if (gesture === null || gesture !== this.gesture) {
      this.past.push(this.state);
      this.past.splice(0, this.past.length - most);
    }
    this.future = [];
    this.state = state;
    this.gesture = gesture;
    this.onChange();
  }

  endGesture() {
    this.gesture = null;
  }

  /** Takes back what the gesture that has not ended yet has changed. */
  cancelGesture() {
    if (this.gesture !== null) {
      this.gesture = null;
      this.state = this.past.pop();
      this.onChange();
    }
  }

  move(from, to) {
    this.gesture = null;
    if (from.length > 0) {
      to.push(this.state);
      this.state = from.pop();
      this.onChange();
    }
  }

  undo() {
    this.move(this.past, this.future);
  }

  redo() {
    this.move(this.future, this.past);
  }
}
