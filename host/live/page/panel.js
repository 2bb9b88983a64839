// What came of a question, in numbers and words.

const element = id => document.getElementById(id);
const write = (place, text) => { if (place.textContent !== text) place.textContent = text; };

// Rows of texts, the first a head where `headed`. Cells that are there are written anew: while a hand moves, little is laid out.
function fill(table, rows, headed) {
  while (table.rows.length > rows.length) table.deleteRow(-1);
  rows.forEach((texts, k) => {
    const row = table.rows[k] ?? table.insertRow();
    while (row.cells.length > texts.length) row.deleteCell(-1);
    while (row.cells.length < texts.length) row.append(document.createElement(headed && k === 0 ? 'th' : 'td'));
    texts.forEach((text, i) => write(row.cells[i], text));
  });
}

function judge(ok, head, text) {
  const verdict = element('verdict');
  verdict.className = ok ? 'yes' : 'no';
  if (!verdict.firstChild) verdict.append(document.createElement('b'), document.createElement('span'));
  write(verdict.firstChild, head);
  write(verdict.lastChild, text);
}

// Behind names: what the number is in.
const units = [[/_g_mm2$/, 'g mm²'], [/_mm2$/, 'mm²'], [/_mm3$/, 'mm³'], [/_mm$/, 'mm'], [/_rpm$/, '1/min'], [/_degrees$/, '°'], [/_g$/, 'g'], [/_seconds$/, 's']];
function named(name) {
  const [end, unit] = units.find(([pattern]) => pattern.test(name)) ?? [null, ''];
  return (end ? name.replace(end, '') : name).replace(/_/g, ' ') + (unit ? `, ${unit}` : '');
}
const number = v => v === null || v === undefined ? '–' : Math.abs(v) < 1e-9 ? '0' : Math.abs(v) >= 1e4 ? v.toFixed(0) : String(Number(v.toPrecision(4)));
const list = values => values.map(v => number(Math.abs(v) < 5e-4 ? 0 : Number(v.toFixed(3)))).join(', ');

// kept: another answer, beside this one; or null.
export function showAnswer(answer, kept) {
  const of = answer.part ?? answer.solid;
  const ok = Boolean(answer.part?.ok), [head, ...rest] = of.text.split(': ');
  judge(ok, answer.part ? `${ok ? '✓' : '✗'} ${head}` : '✗ no interior does it', answer.part ? rest.join(': ') : answer.unmet);
  const rows = [['mass, g', f => number(f.mass_g)], ['centre of mass, mm', f => list(f.centre_of_mass_mm)],
    ['principal moments, g mm²', f => f.principal_moments_g_mm2.map(number).join(', ')],
    ...Object.keys(of.quality).map(name => [named(name), f => number(f.quality[name])])];
  const columns = [['solid', answer.solid], ['part', answer.part], ['kept', kept?.part ?? kept?.solid]].filter(([, f]) => f);
  fill(element('numbers'), [['', ...columns.map(([name]) => name)], ...rows.map(([name, text]) => [name, ...columns.map(([, f]) => text(f))])], true);
}

// Of what no interior does: why.
export function showUnmet(text) { write(element('verdict').lastChild, text); }

export function showNesting(said) {
  judge(said.valid !== false, said.valid === false ? '✗ nothing nests here' : `✓ up to scale ${said.scale.toFixed(4)}`, said.text ? `beyond it: ${said.text}` : '');
  fill(element('numbers'), Object.entries(said.fields).map(([name, value]) => [name, value.split(/[, ]/).map(v => number(Number(v))).join(', ')]));
  for (const place of ['help', 'proof']) if (element(place).firstChild) element(place).replaceChildren();
}

export function showProof(said) {
  write(element('proof'), !said ? '' : said.gap === null ? 'how good the best could be is not proved' :
    `proved: no interior is more than ${number(100 * said.gap)} % better`);
}

const plural = (n, one, more = `${one}s`) => `${n.toLocaleString('en')} ${n === 1 ? one : more}`;

export function showInspection(seen) {
  const lines = [`${plural(seen.triangles, 'triangle')}, ${plural(seen.shells.length, 'shell')}; ${seen.format}`];
  for (const repair of seen.repairs) lines.push(`mended: ${repair}`);
  if (seen.error) lines.push(seen.error);
  if (seen.solid) {
    const s = seen.solid;
    lines.push(`${s.extent_mm.map(v => number(v)).join(' × ')} mm, ${number(s.volume_mm3 / 1000)} cm³; ${number(s.mass_g)} g at 1 g/cm³`);
    if (s.rests.length) lines.push(`dropped on a table it comes to rest in ${plural(s.rests.length, 'way')}, most likely (${number(100 * s.rests[0].probability)} %) with ${list(s.rests[0].up)} upwards`);
    for (const [name, verdict] of Object.entries(s.verified ?? {})) lines.push(`${name}: as a solid it ${verdict.text}`);
  }
  element('inspection').replaceChildren(...lines.map(text => Object.assign(document.createElement('p'), {textContent: text})));
}

let hiding = 0;
export function showTrouble(text) {
  const place = element('trouble');
  place.textContent = text;
  place.hidden = !text;
  clearTimeout(hiding);
  if (text) hiding = setTimeout(() => { place.hidden = true; }, 9000);
}

export const busy = text => { element('busy').textContent = text; };
