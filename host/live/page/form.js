// Controls for the fields that the program has told of: nothing here knows one by its name but where it stands.

const pictures = {
  spin: '<path d="M15 3v6M4 12h22c0 5-6 7-11 15C10 19 4 17 4 12z"/><path d="M22 4a9 9 0 0 1 4 4l1-3"/>',
  top: '<path d="M15 3v5M8 12l14-4 2 5c-2 5-5 9-9 14C10 23 6 18 6 17z"/>',
  yoyo: '<path d="M9 8a7 9 0 0 0 0 18c3 0 4-4 4-9s-1-9-4-9zM21 8a7 9 0 0 1 0 18c-3 0-4-4-4-9s1-9 4-9zM13 17h4M15 17V2"/>',
  stand: '<path d="M4 27h22M10 27c0-6-2-7-2-12a7 7 0 0 1 14 0c0 5-2 6-2 12"/>',
  float: '<path d="M3 20c3-3 5-3 8 0s5 3 8 0 5-3 8 0M7 17c0-7 4-11 8-11s8 4 8 11M3 26c3-3 5-3 8 0s5 3 8 0 5-3 8 0"/>',
  balance: '<path d="M15 14l5 13H10zM4 11h22M6 11V7M24 11V7"/>',
  hang: '<path d="M15 3v9M8 15c0-4 14-4 14 0 3 5-1 12-7 12S5 20 8 15z"/><circle cx="15" cy="3" r="1"/>',
  nest: '<path d="M15 3c8 0 11 5 11 12s-4 12-11 12S4 22 4 15 7 3 15 3zM2 15h26M15 8c4 0 6 3 6 7s-2 7-6 7-6-3-6-7 2-7 6-7z"/>',
  die: '<path d="M15 3l11 6v12l-11 6-11-6V9zM4 9l11 6 11-6M15 15v12"/>',
};

const element = (tag, set = {}, ...inside) => {
  const made = Object.assign(document.createElement(tag), set);
  made.append(...inside);
  return made;
};
// "problem.fluid_density" as a person says it.
const title = name => name.split('.').pop().replace(/[-_]/g, ' ');

// A field's number, without its unit. NaN: it says something else.
const numberOf = (field, text) => text.endsWith(field.range.suffix) ? Number.parseFloat(text.slice(0, text.length - field.range.suffix.length)) : NaN;
const textOf = (field, value) => `${Number(value.toPrecision(4))}${field.range.suffix}`;

// Over several powers of ten a hand moves by shares.
const byShares = ({low, high}) => low > 0 && high / low > 50;
const toHand = (range, v) => byShares(range) ? Math.log(v / range.low) / Math.log(range.high / range.low) : (v - range.low) / (range.high - range.low);
const fromHand = (range, h) => byShares(range) ? range.low * (range.high / range.low) ** h : range.low + h * (range.high - range.low);

export class Form {
  // on(name, text, moving): a field was set; an empty text: as if it had never been said.
  // onPart(name, text): the same of how the part is finished.
  constructor(hello, on, onPart) {
    this.hello = hello;
    this.on = on;
    this.onPart = onPart;
    this.controls = new Map();
    this.form = document.getElementById('form');
    this.goals = document.getElementById('goals');
    this.form.addEventListener('submit', event => event.preventDefault());
    for (const problem of [...hello.problems, {name: 'nest', help: 'a copy inside, as large as can be taken out through a cut'}]) {
      const input = element('input', {type: 'radio', name: 'goal', value: problem.name, ariaLabel: problem.name, onchange: () => this.on('problem', problem.name, false)});
      const goal = element('label', {className: 'goal', title: problem.help}, input);
      goal.insertAdjacentHTML('beforeend', `<svg viewBox="0 0 30 30" aria-hidden="true">${pictures[problem.name] ?? '<circle cx="15" cy="15" r="9"/>'}</svg>${problem.name}`);
      this.goals.append(goal);
    }
  }

  problem(question) { return this.hello.problems.find(p => p.name === question.problem); }

  // The fields that count for a problem, and those that always do.
  names(question) {
    const problem = this.problem(question), first = [...problem.settings, ...problem.shape];
    const always = this.hello.fields.filter(f => f.group === 'pose and material' && f.name.endsWith('density')).map(f => f.name);
    return {first, then: ['size', 'wall', ...always], more: ['resolution', 'deform', 'keep'].filter(name => this.field(name))};
  }
  allows(question, name) {
    const {first, then, more} = this.names(question);
    return name === 'problem' || [...first, ...then, ...more].includes(name);
  }
  field(name) { return this.hello.fields.find(f => f.name === name); }

  // Draws it anew where another problem has other fields, and sets the values.
  show(question) {
    if (this.shown !== question.problem) {
      this.shown = question.problem;
      this.controls.clear();
      const {first, then, more} = this.names(question), block = (legend, names) => element('fieldset', {}, element('legend', {textContent: legend}), ...names.map(n => this.control(this.field(n))));
      const details = element('details', {}, element('summary', {textContent: 'More'}), ...more.map(n => this.control(this.field(n))));
      const part = element('details', {}, element('summary', {textContent: 'The part'}), ...this.hello.part_fields.map(f => this.control(f, (n, text) => this.onPart(n, text))));
      this.form.replaceChildren(...(first.length ? [block(this.shown, first)] : []), block('Size and material', then), details, part);
      for (const input of this.goals.querySelectorAll('input')) input.checked = input.value === this.shown;
    }
    for (const [name, show] of this.controls) show(question[name] ?? '');
  }

  control(field, on = this.on) {
    const id = `field-${field.name}`;
    const usual = field.usual || (field.help.match(/default ([^,;:()]+)/)?.[1] ?? '');
    const text = element('input', {type: 'text', id, placeholder: usual, title: field.help, autocomplete: 'off', spellcheck: false});
    text.addEventListener('change', () => on(field.name, text.value.trim(), false));
    const row = element('div', {className: 'row'});
    let follow = () => {};
    if (field.range) {
      const hand = element('input', {type: 'range', min: 0, max: 1, step: 0.001, ariaLabel: `${title(field.name)}, ${field.unit}`, title: field.help});
      const set = moving => {
        text.value = textOf(field, fromHand(field.range, Number(hand.value)));
        hand.ariaValueText = `${text.value} ${field.unit}`;
        on(field.name, text.value, moving);
      };
      hand.addEventListener('input', () => set(true));
      hand.addEventListener('change', () => set(false));
      row.append(hand);
      follow = value => {
        const v = numberOf(field, value || usual);
        if (document.activeElement !== hand || !hand.matches(':active')) hand.value = Number.isFinite(v) ? Math.min(Math.max(toHand(field.range, v), 0), 1) : 0;
      };
    } else {
      text.className = 'wide';
    }
    row.append(text);
    if (field.choices && !field.range) {
      const list = element('datalist', {id: `${id}-choices`}, ...field.choices.map(value => element('option', {value})));
      text.setAttribute('list', list.id);
      row.append(list);
    }
    if (on === this.on) this.controls.set(field.name, value => {
      if (document.activeElement !== text) text.value = value;
      follow(value);
    });
    return element('div', {className: 'field'}, element('label', {htmlFor: id, title: field.help}, title(field.name), element('small', {textContent: field.unit})), row);
  }
}
