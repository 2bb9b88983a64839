// The way to the program: JSON both ways, and bytes behind a line of it. [docs/live.md]

export class Link {
  // on: what is done with each kind of message: {answer: (said, bytes) => ...}; "down" when there is no way any more.
  constructor(on) {
    this.on = on;
    this.waiting = [];
    this.next = 0;
    this.socket = new WebSocket(new URL('socket', location.href).href.replace(/^http/, 'ws').replace(/[?#].*/, ''));
    this.socket.binaryType = 'arraybuffer';
    this.socket.onopen = () => this.waiting.splice(0).forEach(bytes => this.socket.send(bytes));
    this.socket.onmessage = event => this.take(event.data);
    this.socket.onclose = () => this.on.down();
  }

  // Returns the request's id, which its answers repeat.
  ask(name, said = {}, bytes = null) {
    const id = ++this.next, text = JSON.stringify({do: name, id, ...said});
    const message = bytes ? new Blob([text, '\n', bytes]) : text;
    if (this.socket.readyState === WebSocket.CONNECTING) this.waiting.push(message);
    else this.socket.send(message);
    return id;
  }

  take(data) {
    let text = data, bytes = null;
    if (typeof data !== 'string') {
      const all = new Uint8Array(data), end = all.indexOf(10);
      text = new TextDecoder().decode(all.subarray(0, end));
      bytes = data.slice(end + 1);
    }
    const said = JSON.parse(text);
    this.on[said.do]?.(said, bytes);
  }
}
