// Parts that are made by the program, and what would help where none can be.

const make = (tag, set = {}, ...inside) => {
  const made = Object.assign(document.createElement(tag), set);
  made.append(...inside);
  return made;
};

export class Parts {
  // link: to ask for them; each has its place in the list.
  constructor(place, link) {
    this.place = place;
    this.link = link;
    this.made = new Map();
  }

  ask(question, part, title) {
    const step = make('p', {textContent: 'waits …'}), stop = make('button', {type: 'button', textContent: 'Stop'});
    const card = make('article', {className: 'part', ariaLive: 'polite'}, make('b', {textContent: title}), make('progress'), step, stop);
    const id = this.link.ask('make', {question, part});
    this.made.set(id, {card, step, stop});
    stop.onclick = () => {
      this.link.ask('stop');
      this.end(id, 'stopped');
    };
    this.place.prepend(card);
    return id;
  }
  step({id, text}) {
    const at = this.made.get(id);
    if (at) at.step.textContent = `${text} …`;
  }
  file({id, name}, bytes) {
    const size = bytes.byteLength, unit = size > 1e6 ? `${(size / 1e6).toFixed(1)} MB` : `${Math.ceil(size / 1e3)} kB`;
    const type = name.endsWith('.html') ? 'text/html' : 'application/octet-stream';
    this.made.get(id)?.card.append(make('a', {href: URL.createObjectURL(new Blob([bytes], {type})), download: name, textContent: `${name}, ${unit}`}));
  }
  done({id, ok, text, report}) {
    const at = this.made.get(id);
    if (!at) return;
    at.card.classList.add(ok ? 'yes' : 'no');
    at.card.append(make('a', {href: URL.createObjectURL(new Blob([JSON.stringify(report, null, 2)], {type: 'application/json'})), download: 'report.json', textContent: 'report.json'}));
    this.end(id, `${ok ? '✓' : '✗'} ${text}`);
  }
  // An error of one of these. Returns whether it was.
  failed({id, text}) { return this.end(id, `✗ ${text}`); }

  end(id, text) {
    const at = this.made.get(id);
    if (!at) return false;
    at.card.querySelector('progress')?.remove();
    at.stop.remove();
    at.step.textContent = text;
    return true;
  }
}

// Options of the command line in a sentence, as they are read here: directions rounded, places left out.
const inWords = sentence => sentence.replace(/\s*--([a-z-]+) ([^\s;]+)/g, (_, name, value) =>
  name === 'contact' ? '' : ` ${name} ${value.replace(/,$/, '').split(',').map(v => v === '' || Number.isNaN(Number(v)) ? v : Number(Number(v).toFixed(2))).join(', ')}`).trim();

// Buttons that set what would help. set(fields)
export function showHelp(place, {title, remedies, poses, also = []}, set) {
  const buttons = [];
  const button = (text, fields) => buttons.push(make('button', {type: 'button', textContent: text, onclick: () => set(fields)}));
  for (const {text, fields} of [...remedies, ...also]) Object.keys(fields).length ? button(text, fields) : buttons.push(make('p', {textContent: text}));
  // What of a sentence is options of the command line are fields, too.
  for (const piece of poses.split('; ')) {
    const fields = Object.fromEntries([...piece.matchAll(/--([a-z-]+) ([^\s;]+)/g)].map(([, name, value]) => [name, value.replace(/,$/, '')]));
    if (Object.keys(fields).length) button(inWords(piece), fields);
  }
  place.replaceChildren(make('h2', {textContent: title}), ...buttons);
}
