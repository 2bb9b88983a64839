// One shape in another: the inner one is dragged and turned, the cut plane is tilted and moved, and the largest scale follows.
import {skin} from './shaders.js';
import {colours} from './scene.js';

const vector = list => new THREE.Vector3(...list);
const text = v => v.toArray().map(n => Number(n.toFixed(5))).join(',');
const degrees = 180 / Math.PI;

export class Nest {
  // link: to ask; told(said): an answer was drawn.
  constructor(scene, link, told) {
    this.scene = scene;
    this.link = link;
    this.told = told;
    this.group = new THREE.Group();
    this.group.visible = false;
    this.shift = {value: 0};
    this.inner = this.mesh(colours.cavity, 1);
    this.inner.matrixAutoUpdate = false;
    this.halves = [1, -1].map(side => Object.assign(this.mesh(colours.skin, 0.4), {side}));
    const basic = (geometry, colour, opacity) => new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({color: colour, transparent: true, opacity, side: THREE.DoubleSide, depthWrite: false}));
    this.plane = basic(new THREE.CircleBufferGeometry(1, 64), colours.shell, 0.25);
    this.knob = basic(new THREE.SphereBufferGeometry(1, 24, 16), colours.shell, 1);
    this.block = basic(new THREE.SphereBufferGeometry(1, 24, 16), colours.axis, 1);
    this.block.material.depthTest = false;
    this.group.add(this.inner, ...this.halves, this.plane, this.knob, this.block);
    for (const [k, object] of [this.inner, ...this.halves, this.plane, this.knob, this.block].entries()) object.renderOrder = 2 + k;
    scene.scene.add(this.group);
    scene.onDraw.push(camera => this.place(camera));
    const canvas = scene.canvas;
    canvas.addEventListener('pointerdown', event => this.take(event), true);
    canvas.addEventListener('pointermove', event => this.move(event), true);
    for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, event => this.let(event), true);
  }

  mesh(colour, opacity) {
    const cut = {cutting: {value: false}, cutNormal: {value: new THREE.Vector3(0, 0, 1)}, cutAt: {value: 0}};
    const material = this.scene.material(skin, {colour: {value: new THREE.Color(colour)}, opacity: {value: opacity}, ...cut}, opacity < 1 ? {transparent: true, depthWrite: false} : {});
    return Object.assign(new THREE.Mesh(new THREE.BufferGeometry(), material), {frustumCulled: false});
  }

  open(inner) {
    this.field = {plane: '0,0,1'};
    this.answer = null;
    this.pending = null;
    this.link.ask('into', inner ? {inner} : {});
  }
  close() {
    this.group.visible = false;
    this.link.ask('stop');
    this.scene.showSolid(true);
  }
  // Both shapes are here.
  ready() {
    this.scene.give(this.halves, this.scene.body.surface.whole);
    this.ask(false);
  }
  surface(geometry) {
    this.scene.give([this.inner], geometry);
    geometry.computeBoundingSphere();
  }

  ask(moving) {
    this.sent = performance.now();
    this.moving = moving;
    this.link.ask('nest', {question: this.field, moving});
  }
  optimise(free, seconds) { this.link.ask('optimise', {question: {...this.field, free, seconds: String(seconds), particles: '60'}}); }

  show(answer, follow = false) {
    this.answer = answer;
    if (!this.group.visible) this.scene.showSolid(false);
    this.group.visible = true;
    if (follow) this.field = {...answer.fields};
    const [x, y, z] = answer.transform;
    this.inner.matrix.set(...x, ...y, ...z, 0, 0, 0, 1);
    this.inner.matrixWorldNeedsUpdate = true;
    this.normal = vector(answer.plane_normal);
    this.through = vector(answer.plane_point);
    if (!this.field.centroid) this.field = {...answer.fields};
    this.block.visible = Boolean(answer.blocked_at);
    if (answer.blocked_at) this.block.position.copy(vector(answer.blocked_at));
    this.scene.redraw(follow || this.moving);
    this.told(answer);
  }
  apart(share) {
    this.shift.value = share;
    this.scene.redraw(true);
  }

  place(camera) {
    if (!this.group.visible || !this.answer) return;
    const radius = this.scene.orbit.radius, small = 0.022 * camera.position.distanceTo(this.scene.orbit.middle) * Math.tan(0.5 * camera.fov * Math.PI / 180) * 2;
    const at = this.normal.dot(this.through), middle = this.scene.orbit.middle;
    this.plane.position.copy(middle).addScaledVector(this.normal, at - this.normal.dot(middle));
    this.plane.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), this.normal);
    this.plane.scale.setScalar(1.15 * radius);
    this.knob.position.copy(this.plane.position).addScaledVector(this.normal, 1.25 * radius);
    this.knob.scale.setScalar(0.6 * small);
    this.block.scale.setScalar(0.5 * small);
    for (const half of this.halves) {
      const uniforms = half.material.uniforms;
      uniforms.cutting.value = true;
      uniforms.cutNormal.value.copy(this.normal).multiplyScalar(-half.side);
      half.position.copy(vector(half.side > 0 ? this.answer.plus : this.answer.minus)).multiplyScalar(1.5 * radius * this.shift.value);
      uniforms.cutAt.value = -half.side * at + uniforms.cutNormal.value.dot(half.position);
    }
  }

  take(event) {
    if (!this.group.visible || !this.answer || event.button > 0) return;
    const caster = this.scene.rayAt(event), camera = this.scene.orbit.camera;
    const near = point => caster.ray.distanceToPoint(point) / point.distanceTo(camera.position) < 0.016;
    if (near(this.knob.position)) this.held = 'plane';
    else if (caster.intersectObject(this.inner).length) this.held = event.shiftKey || event.altKey ? 'turn' : 'inner';
    else return;
    event.preventDefault();
    this.last = event;
    this.scene.canvas.setPointerCapture(event.pointerId);
  }
  let(event) {
    if (!this.held) return;
    event.stopPropagation();
    this.held = null;
    this.ask(false);
  }
  move(event) {
    if (!this.held) return;
    event.stopPropagation();
    const camera = this.scene.orbit.camera, caster = this.scene.rayAt(event), axis = k => new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, k);
    const dx = event.clientX - this.last.clientX, dy = event.clientY - this.last.clientY;
    this.last = event;
    if (this.held === 'plane') {
      const middle = this.scene.orbit.middle, far = 1.25 * this.scene.orbit.radius;
      const hit = caster.ray.intersectSphere(new THREE.Sphere(middle, far), new THREE.Vector3()) ?? caster.ray.closestPointToPoint(middle, new THREE.Vector3());
      this.field = {...this.field, plane: text(hit.sub(middle).normalize())};
      delete this.field.removal;
    } else if (this.held === 'turn') {
      const now = vector(this.field.rotation.split(',').map(Number)), turn = new THREE.Quaternion().setFromAxisAngle(now.clone().normalize(), now.length() / degrees);
      turn.premultiply(new THREE.Quaternion().setFromAxisAngle(axis(1), 0.01 * dx)).premultiply(new THREE.Quaternion().setFromAxisAngle(axis(0), 0.01 * dy));
      const angle = 2 * Math.acos(Math.min(Math.max(turn.w, -1), 1)), sine = Math.sin(angle / 2);
      this.field = {...this.field, rotation: text(sine < 1e-9 ? new THREE.Vector3() : new THREE.Vector3(turn.x, turn.y, turn.z).multiplyScalar(angle * degrees / sine))};
    } else {
      const at = vector(this.field.centroid.split(',').map(Number));
      const step = 2 * at.distanceTo(camera.position) * Math.tan(0.5 * camera.fov * Math.PI / 180) / this.scene.canvas.clientHeight;
      const by = axis(0).multiplyScalar(step * dx).addScaledVector(axis(1), -step * dy);
      this.field = {...this.field, centroid: text(at.add(by)), through: text(vector(this.field.through.split(',').map(Number)).add(by))};
    }
    this.ask(true);
  }
}
