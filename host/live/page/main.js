// The page: what is asked goes to the program, what comes back is drawn.
import {Form} from './form.js';
import {Link} from './link.js';
import {Marks} from './marks.js';
import {Motion} from './motion.js';
import {Nest} from './nest.js';
import {Parts, showHelp} from './parts.js';
import {busy, showAnswer, showInspection, showNesting, showProof, showTrouble, showUnmet} from './panel.js';
import {Scene, colours, geometryOf} from './scene.js';
import {State} from './state.js';

const element = id => document.getElementById(id);
const three = n => Number(n.toFixed(5));
const text = v => [v.x, v.y, v.z].map(three).join(',');

window.onerror = message => showTrouble(String(message));
window.onunhandledrejection = event => showTrouble(String(event.reason?.message ?? event.reason));

const scene = new Scene(element('view'));
const state = new State(() => { reopen(); });
let hello = null, form = null, question = {}, part = {}, answer = null, kept = null, framed = false, latest = 0, opened = '', sent = new Map();

const link = new Link({
  hello(said) {
    hello = said;
    element('model').append(...hello.models.map(name => new Option(name, name)));
    form = new Form(hello, set, (name, value) => { part = {...part, [name]: value}; });
    const kept = State.fromLink();
    begin(kept && hello.models.includes(kept.model) ? kept : {model: hello.model || 'ellipsoid', question: {problem: usual('problem')}});
  },
  opened(said) {
    busy('');
    element('make').disabled = true;
    framed = false;
    if (said.trouble) {
      showTrouble(said.trouble);
      startDrawing();
      scene.cavity(null);
      if (said.trouble.includes('unit')) askUnit(said.model);
      return;
    }
    ask(false);
  },
  inspected: showInspection,
  surface(said, bytes) {
    if (said.name === 'inner') return nest.surface(geometryOf(said, bytes));
    scene.surface(said, bytes);
    if (said.name === 'body' && answer && !framed) frame();
  },
  answer(said) {
    if (said.id < latest) return;
    latest = said.id;
    answer = said;
    scene.cavity(said);
    marks.show(said);
    showAnswer(said, kept);
    showProof(null);
    marks.showMap(null);
    element('help').replaceChildren();
    if (!said.feasible && !said.moving) {
      link.ask('help', {question: asked()});
      if (form.problem(question).mapped) link.ask('map', {question: asked()});
    }
    element('make').disabled = !said.feasible;
    if (!framed && scene.body.visible) frame();
    measure(said);
    startDrawing();
  },
  unmet(said) { if (said.id === latest) showUnmet(said.text); },
  certificate(said) { if (said.id === latest) showProof(said); },
  into() {
    busy('');
    if (!framed) {
      framed = true;
      scene.frame(new THREE.Vector3(0, 0, 1));
    }
    nest.ready();
    startDrawing();
  },
  nesting: said => nest.show(said),
  better: said => nest.show(said, true),
  optimised(said) {
    busy('');
    nest.show(said, true);
    nest.ask(false);
  },
  help(said) { if (answer && !answer.feasible) showHelp(element('help'), {...said, title: 'What would help', also: [{text: 'let the shape change, as little as does', fields: {deform: 'least'}}]}, setAll); },
  map(said) { if (answer && !answer.feasible) marks.showMap(said); },
  motion(said) {
    busy('left: the solid; right: the part');
    motion.play(said);
  },
  step: said => parts.step(said),
  file: (said, bytes) => parts.file(said, bytes),
  made: said => parts.done(said),
  error(said) {
    busy('');
    startDrawing();
    if (parts.failed(said)) return;
    showTrouble(said.text);
  },
  down() {
    busy('The program has ended, or the tab was too slow: start it again, and open the address that it prints.');
    element('make').disabled = true;
  },
});

// After what was said is on the page.
const startDrawing = () => requestAnimationFrame(() => setTimeout(() => scene.start(), 0));

const motion = scene.motion = new Motion(scene);
const parts = new Parts(element('parts'), link);

const nestTimes = [];
const nest = new Nest(scene, link, said => {
  showNesting(said);
  if (said.do !== 'nesting' || nest.sent === null) return;
  const began = nest.sent;
  nest.sent = null;
  const written = performance.now() - began;
  requestAnimationFrame(() => setTimeout(() => nestTimes.push({written, ms: performance.now() - began}), 0));
});

const marks = new Marks(scene, {
  axis: (direction, moving) => set(form.problem(question).upright ? 'up' : 'axis', text(direction), moving),
  contact: (point, moving) => set('contact', text(point), moving),
  water: (depth, moving) => {
    const height = scene.box.getSize(new THREE.Vector3()).length();
    set('problem.draft', `${Math.min(Math.max(depth, 0.01 * height), height).toFixed(2)}mm`, moving);
  },
});

const usual = name => hello.fields.find(f => f.name === name)?.usual ?? '';

function frame() {
  framed = true;
  scene.frame(new THREE.Vector3(...answer.axis));
}

// From when somebody did something to when its numbers are written into the page, and to when the browser has drawn them.
const times = [];
function measure(said) {
  const began = sent.get(said.id);
  for (const id of sent.keys()) if (id <= said.id) sent.delete(id);
  if (began === undefined) return;
  window.kreisel.firstAnswer ??= performance.now();
  const written = performance.now() - began.at;
  requestAnimationFrame(() => setTimeout(() => times.push({what: began.what, written, ms: performance.now() - began.at, coarse: said.coarse, moving: said.moving}), 0));
}

function ask(moving, what = '') {
  const id = link.ask('ask', {question: form ? asked() : {}, moving});
  sent.set(id, {at: performance.now(), what});
}

// Only what counts for the problem that is asked.
const asked = () => Object.fromEntries(Object.entries(question).filter(([name, value]) => value !== '' && form.allows(question, name)));

function set(name, value, moving) {
  setAll({[name]: value}, moving);
}
function setAll(fields, moving = false) {
  const [name] = Object.keys(fields);
  if (fields.problem) nesting(fields.problem === 'nest');
  if (fields.problem === 'nest') return;
  question = Object.fromEntries(Object.entries({...question, ...fields}).filter(([, value]) => value !== ''));
  if (fields.problem) question = {...problemSettings(fields.problem), ...question};
  form.show(question);
  ask(moving, name);
  if (!moving) {
    state.add({model: opened, question});
    buttons();
  }
}
const problemSettings = name => Object.fromEntries(Object.entries(hello.problems.find(p => p.name === name)?.begins ?? {}).map(([k, v]) => [`problem.${k}`, v]));

function begin({model, question: said}) {
  question = said;
  form.show(question);
  open(model);
  state.add({model, question});
  buttons();
}

// Meshes that were sent in this tab, by their names: undo may come back to one.
const files = new Map();

// Lengths that can hardly be millimetres, in a file that says no unit.
function askUnit(model) {
  const units = hello.fields.find(f => f.name === 'unit').choices;
  showHelp(element('help'), {title: 'In what are its lengths?', remedies: units.map(unit => ({text: unit, fields: {unit}})), poses: ''}, fields => open(model, fields));
}

function open(model, fields = {}) {
  const file = files.get(model) ?? null;
  opened = model;
  busy(`opening ${model} …`);
  if (![...element('model').options].some(o => o.value === model)) element('model').prepend(new Option(model, model));
  element('model').value = model;
  document.title = `${model}: Kreisel`;
  answer = null;
  element('help').replaceChildren();
  link.ask('open', {model, sent: Boolean(file), fields}, file);
}

// After undo and redo.
function reopen() {
  const {model, question: said} = state.now;
  question = said;
  form.show(question);
  buttons();
  if (model !== opened) open(model);
  else ask(false);
}

// Another tool in the same view.
function nesting(on) {
  document.body.dataset.tool = on ? 'nest' : 'solve';
  scene.marks.visible = !on && Boolean(answer);
  scene.shared.cutting.value = !on && Number(element('cut').value) > 0;
  if (on) {
    scene.cavity(null);
    nest.open('');
  } else if (nest.group.visible) {
    nest.close();
  }
}

function buttons() {
  element('undo').disabled = !state.canUndo;
  element('redo').disabled = !state.canRedo;
}

function send(file) {
  if (!file) return;
  if (file.size > hello.largest_mesh) return showTrouble(`${file.name} is larger than ${Math.round(hello.largest_mesh / 1e6)} MB`);
  files.set(file.name, file);
  begin({model: file.name, question: {problem: question.problem}});
}

element('model').onchange = () => begin({model: element('model').value, question: {problem: question.problem}});
element('choose').onclick = () => element('file').click();
element('file').onchange = () => send(element('file').files[0]);
element('undo').onclick = () => state.go(-1);
element('redo').onclick = () => state.go(1);
element('cut').oninput = () => scene.cut(Number(element('cut').value));
element('make').onclick = () => parts.ask(asked(), part, `${opened}: ${question.problem}`);
element('play').onclick = () => {
  if (motion.playing) return motion.end();
  busy('setting it in motion …');
  link.ask('move', {question: asked()});
};
element('keep').onclick = () => {
  kept = answer;
  scene.drawNow();
  element('kept').querySelector('img').src = element('view').toDataURL();
  element('kept').querySelector('span').textContent = `${question.problem}, ${Number((kept.part ?? kept.solid).mass_g.toPrecision(4))} g`;
  element('kept').hidden = false;
  showAnswer(answer, kept);
};
element('kept').querySelector('button').onclick = () => {
  kept = null;
  element('kept').hidden = true;
  if (answer) showAnswer(answer, kept);
};
element('go').onclick = () => {
  busy('looking for a larger one …');
  nest.optimise([...document.querySelectorAll('#nest input[name=free]:checked')].map(box => box.value).join(',') || 'position', 30);
};
element('halt').onclick = () => {
  link.ask('stop');
  busy('');
};
element('apart').oninput = () => nest.apart(Number(element('apart').value));
element('face').onclick = () => scene.faceCut();
element('glass').onchange = () => scene.glass(element('glass').checked);
element('link').onclick = async () => {
  await navigator.clipboard?.writeText(location.href);
  busy('the link is copied');
  setTimeout(() => busy(''), 2000);
};
const dark = matchMedia('(prefers-color-scheme: dark)');
const theme = name => {
  document.documentElement.dataset.theme = name;
  scene.redraw();
};
theme(localStorage.getItem('theme') ?? (dark.matches ? 'dark' : 'light'));
element('theme').onclick = () => {
  const name = document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark';
  localStorage.setItem('theme', name);
  theme(name);
};
document.addEventListener('keydown', event => {
  if (!(event.ctrlKey || event.metaKey) || event.target.matches('input[type=text]')) return;
  if (event.key === 'z') state.go(event.shiftKey ? 1 : -1);
  else if (event.key === 'y') state.go(1);
  else return;
  event.preventDefault();
});
document.addEventListener('dragover', event => {
  event.preventDefault();
  element('drop').hidden = false;
});
document.addEventListener('dragleave', event => { if (!event.relatedTarget) element('drop').hidden = true; });
document.addEventListener('drop', event => {
  event.preventDefault();
  element('drop').hidden = true;
  send(event.dataTransfer.files[0]);
});

for (const [name, colour, round] of [['material, cut', colours.shell], ['cavity, at the wall', colours.cavity], ['cavity, by the quadric', colours.quadric],
  ['centre of mass, solid', colours.solid, true], ['centre of mass, part', colours.part, true]]) {
  const item = element('legend').appendChild(document.createElement('li'));
  item.append(Object.assign(document.createElement('i'), {className: round ? 'round' : '', style: `background:${colour}`}), name);
}
scene.cut(Number(element('cut').value));
link.ask('hello');

// For tests, and for whoever wants to know.
window.kreisel = {scene, marks, motion, nest, nestTimes, times, set, setAll, get answer() { return answer; }, get question() { return question; }};
