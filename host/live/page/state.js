// The question as it stands, and as it stood: what undo goes back to and what a link holds.

export class State {
  // changed(): the question is another one, not by a hand that still moves.
  constructor(changed) {
    this.changed = changed;
    this.steps = [];
    this.at = -1;
  }

  get now() { return this.steps[this.at]; }
  get canUndo() { return this.at > 0; }
  get canRedo() { return this.at < this.steps.length - 1; }

  // A step of its own, from which undo comes back.
  add(question) {
    if (this.now && JSON.stringify(this.now) === JSON.stringify(question)) return;
    this.steps.splice(this.at + 1, Infinity, question);
    this.at = this.steps.length - 1;
    this.keep();
  }
  go(by) {
    const to = this.at + by;
    if (to < 0 || to >= this.steps.length) return;
    this.at = to;
    this.keep();
    this.changed();
  }
  // The address holds it all: another browser that opens it shows the same.
  keep() { history.replaceState(null, '', `#${encodeURIComponent(JSON.stringify(this.now))}`); }

  static fromLink() {
    try {
      const said = JSON.parse(decodeURIComponent(location.hash.slice(1)));
      return said && typeof said.model === 'string' && typeof said.question === 'object' ? said : null;
    } catch {
      return null;
    }
  }
}
