// What the parts of the page share: the station under the cursor, the x axis, units, theme.

export class Store {
  constructor(state) {
    this.state = state;
    this.listeners = new Map();
  }

  get(key) {
    return this.state[key];
  }

  set(key, value) {
    if (this.state[key] === value) return;
    this.state[key] = value;
    for (const listener of this.listeners.get(key) ?? []) listener(value);
  }

  on(key, listener) {
    if (!this.listeners.has(key)) this.listeners.set(key, []);
    this.listeners.get(key).push(listener);
  }
}
