// What is seen: the solid, its cavity, and what is drawn on them.
import {counting, roots, skin, walls} from './shaders.js';
import {lighter} from './lighter.js';
import {Orbit} from './orbit.js';

export const colours = {
  skin: '#b4c0cb', shell: '#e8a33d', interior: '#c9702a', cavity: '#52b3a4', quadric: '#6aa6d8', solid: '#d9822b', part: '#1f6fb2', axis: '#c43d6b',
  water: '#3f8fd0', never: '#d3ab86',
};
const rgb = colour => new THREE.Color(colour);

// Whether the processor draws: then four samples a pixel are too many.
function isSoftware() {
  const gl = document.createElement('canvas').getContext('webgl'), info = gl?.getExtension('WEBGL_debug_renderer_info');
  return /swiftshader|llvmpipe|software/i.test(info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : '');
}

export function geometryOf(said, bytes) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(bytes, 0, 3 * said.corners), 3));
  geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(bytes, 12 * said.corners, 3 * said.triangles), 1));
  geometry.computeVertexNormals();
  geometry.computeBoundingBox();
  geometry.computeBoundingSphere();
  return geometry;
}

export class Scene {
  constructor(canvas) {
    this.canvas = canvas;
    this.orbit = new Orbit(canvas, moving => this.redraw(moving));
    this.scene = new THREE.Scene();
    this.counted = new THREE.Scene();
    this.onDraw = [];
    this.given = new Set();
    this.counts = new THREE.WebGLRenderTarget(1, 1, {type: THREE.HalfFloatType, minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter, depthBuffer: false, stencilBuffer: false});
    this.shared = {
      toBody: {value: new THREE.Matrix4()}, q1: {value: new THREE.Vector4()}, q2: {value: new THREE.Vector3()}, q3: {value: new THREE.Vector3()},
      middle: {value: new THREE.Vector3()}, cutNormal: {value: new THREE.Vector3(1, 0, 0)}, cutAt: {value: 0}, voidSign: {value: 1},
      hollow: {value: false}, cutting: {value: true}, counts: {value: this.counts.texture}, part: {value: new THREE.Vector2(0, 1)}, fromScreen: {value: new THREE.Matrix4()}, projection: {value: new THREE.Matrix4()},
      cavityColour: {value: rgb(colours.quadric)}, shellColour: {value: rgb(colours.shell)}, interiorColour: {value: rgb(colours.shell)},
    };
    this.build();
    new ResizeObserver(() => this.redraw()).observe(canvas);
  }

  // Begins to draw. That takes a second where the processor draws, so numbers may come first.
  start() {
    if (this.gl) return;
    this.slow = isSoftware();
    const context = this.gl = this.canvas.getContext('webgl2', {antialias: !this.slow, alpha: false});
    if (!context || !context.getExtension('EXT_color_buffer_float')) throw new Error('this browser draws no WebGL 2 with floating-point targets');
    this.renderer = new THREE.WebGLRenderer({canvas: this.canvas, context});
    this.renderer.autoClear = false;
    this.redraw(true);
  }

  material(shader, own, settings) {
    const material = new THREE.ShaderMaterial({...shader, side: THREE.DoubleSide, ...settings});
    material.uniforms = {...this.shared, ...own};
    return material;
  }

  build() {
    const adding = {transparent: true, depthTest: false, depthWrite: false, blending: THREE.CustomBlending, blendEquation: THREE.AddEquation,
      blendSrc: THREE.OneFactor, blendDst: THREE.OneFactor, blendSrcAlpha: THREE.OneFactor, blendDstAlpha: THREE.OneFactor};
    const none = new THREE.BufferGeometry(), mesh = (material, order) => Object.assign(new THREE.Mesh(none, material), {renderOrder: order, frustumCulled: false, visible: false});
    this.skinOpacity = {value: 1};
    this.body = mesh(this.material(skin, {colour: {value: rgb(colours.skin)}, opacity: this.skinOpacity}), 2);
    this.walls = mesh(this.material(walls, {colour: {value: rgb(colours.cavity)}}), 0);
    this.countedBody = mesh(this.material(counting, {isSkin: {value: true}}, adding), 0);
    this.countedOffset = mesh(this.material(counting, {isSkin: {value: false}}, adding), 0);
    this.screen = mesh(this.material(roots), 1);
    this.screen.geometry = new THREE.PlaneBufferGeometry(2, 2);
    this.screen.visible = true;
    this.cavityParts = new THREE.Group();
    this.cavityParts.add(this.walls, this.screen);
    this.scene.add(this.cavityParts, this.body);
    this.counted.add(this.countedBody, this.countedOffset);
    this.marks = new THREE.Group();
    this.marks.renderOrder = 5;
    this.scene.add(this.marks);
  }

  surface(said, bytes) {
    const meshes = {body: [this.body, this.countedBody], offset: [this.walls, this.countedOffset]}[said.name];
    const geometry = geometryOf(said, bytes);
    this.give(meshes, geometry);
    for (const mesh of meshes) mesh.visible = said.triangles > 0;
    if (said.name === 'body') {
      this.walls.visible = this.countedOffset.visible = false;
      this.shared.middle.value.copy(geometry.boundingSphere.center);
      this.box = geometry.boundingBox;
    }
    this.redraw(true);
  }

  // What meshes show, and a lighter one instead while a slow picture moves.
  give(meshes, geometry) {
    const surface = {whole: geometry, light: null};
    for (const mesh of meshes) {
      const before = mesh.surface;
      mesh.surface = surface;
      mesh.geometry = geometry;
      this.given.add(mesh);
      if (before && ![...this.given].some(other => other.surface === before)) for (const old of [before.whole, before.light]) old?.dispose();
    }
  }
  weigh(light) {
    for (const mesh of this.given) {
      const surface = mesh.surface;
      if (light && !surface.light) surface.light = surface.whole.index.count > 3 * 12000 ? lighter(surface.whole) : surface.whole;
      mesh.geometry = light ? surface.light : surface.whole;
    }
  }

  // Shows the body with `up` upwards.
  frame(up) {
    const sphere = this.body.geometry.boundingSphere;
    this.orbit.look(sphere.center, 1.2 * sphere.radius, up);
    this.faceCut();
  }

  // The cavity of an answer; nothing: there is none.
  cavity(answer) {
    const shared = this.shared;
    shared.hollow.value = Boolean(answer && answer.quadric);
    if (shared.hollow.value) {
      const {rotation: r, origin: o, length: l} = answer.frame, c = answer.quadric, largest = Math.max(...c.map(Math.abs));
      const rows = r.map(row => [row[0] / l, row[1] / l, row[2] / l, -(row[0] * o[0] + row[1] * o[1] + row[2] * o[2]) / l]);
      shared.toBody.value.set(...rows[0], ...rows[1], ...rows[2], 0, 0, 0, 1);
      const q = c.map(v => v / largest);
      shared.q1.value.set(q[0], q[1], q[2], q[3]);
      shared.q2.value.set(q[4], q[5], q[6]);
      shared.q3.value.set(q[7], q[8], q[9]);
      shared.voidSign.value = answer.void_where === 'positive' ? 1 : -1;
    }
    if (answer) shared.interiorColour.value = rgb(answer.interior_density === answer.density ? colours.shell : colours.interior);
    this.redraw(Boolean(answer?.moving));
  }

  // Shows the solid and its cavity; or neither, where another tool shows its own.
  showSolid(on) {
    this.body.visible = this.cavityParts.visible = this.counted.visible = on;
    this.redraw();
  }

  // share: 0, whole, to 1, all cut away.
  cut(share) {
    this.cutShare = share;
    this.shared.cutting.value = share > 0;
    this.placeCut();
    this.redraw(true);
  }
  faceCut() {
    this.shared.cutNormal.value.copy(this.orbit.outward());
    this.placeCut();
    this.redraw();
  }
  placeCut() {
    if (!this.box) return;
    const n = this.shared.cutNormal.value, ends = [Infinity, -Infinity];
    for (let k = 0; k < 8; ++k) {
      const at = n.x * this.box[k & 1 ? 'max' : 'min'].x + n.y * this.box[k & 2 ? 'max' : 'min'].y + n.z * this.box[k & 4 ? 'max' : 'min'].z;
      ends[0] = Math.min(ends[0], at);
      ends[1] = Math.max(ends[1], at);
    }
    this.shared.cutAt.value = ends[1] - this.cutShare * (ends[1] - ends[0]);
  }
  glass(on) {
    this.skinOpacity.value = on ? 0.35 : 1;
    Object.assign(this.body.material, {transparent: on, depthWrite: !on});
    this.redraw();
  }

  // moving: the picture changes again soon, and may be coarser until then.
  redraw(moving = false) {
    if (moving) {
      this.moving = true;
      clearTimeout(this.resting);
      this.resting = setTimeout(() => { this.moving = false; this.redraw(); }, 180);
    }
    this.wanted ??= requestAnimationFrame(() => { this.wanted = null; this.draw(); });
  }

  draw() {
    if (this.fence) {  // the one before is not drawn yet: frames that queue up would hold up the numbers, too
      this.again = true;
      return;
    }
    this.drawNow();
  }

  drawNow() {
    if (!this.renderer) return;
    const began = performance.now();
    const canvas = this.canvas, camera = this.orbit.place(), light = Boolean(this.moving && this.slow), ratio = light ? this.motion?.playing ? 0.5 : 0.36 : Math.min(devicePixelRatio, 2);
    this.weigh(light);
    const width = Math.max(Math.round(canvas.clientWidth * ratio), 1), height = Math.max(Math.round(canvas.clientHeight * ratio), 1);
    if (canvas.width !== width || canvas.height !== height) {
      this.renderer.setSize(width, height, false);
      this.counts.setSize(width, height);
    }
    this.renderer.setRenderTarget(null);
    this.renderer.setClearColor(rgb(getComputedStyle(document.body).getPropertyValue('--back').trim()), 1);
    this.renderer.clear();
    if (this.motion?.playing) this.motion.draw(camera, (eye, side, hollow) => this.drawHalf(eye, side, hollow, width, height));
    else this.drawFrom(camera, 0, width, height);
    this.drawn = (this.drawn ?? 0) + 1;
    if (!this.fence) this.time(began);
  }

  // The left or the right half, from another eye; the solid, or what is left of it.
  drawHalf(camera, side, hollow, width, height) {
    const shared = this.shared, was = [shared.hollow.value, shared.cutting.value, this.marks.visible], half = Math.floor(width / 2);
    shared.hollow.value = hollow && was[0];
    shared.cutting.value = hollow && was[1];
    this.marks.visible = false;
    camera.aspect = half / height;
    camera.updateProjectionMatrix();
    this.drawFrom(camera, side * half, half, height);
    [shared.hollow.value, shared.cutting.value, this.marks.visible] = was;
  }

  drawFrom(camera, left, width, height) {
    const shared = this.shared, ratio = this.renderer.getPixelRatio();
    shared.projection.value.copy(camera.projectionMatrix);
    shared.fromScreen.value.getInverse(new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse));
    for (const prepare of this.onDraw) prepare(camera);
    shared.part.value.set(left / this.counts.width, width / this.counts.width);
    this.counts.viewport.set(left, 0, width, height);
    this.renderer.setClearColor(0x000000, 0);
    this.renderer.setRenderTarget(this.counts);
    this.renderer.clear();
    this.renderer.render(this.counted, camera);
    this.renderer.setRenderTarget(null);
    this.renderer.setViewport(left / ratio, 0, width / ratio, height / ratio);
    this.renderer.render(this.scene, camera);
  }

  // How long frames take, until they are drawn and not only asked for.
  time(began) {
    const gl = this.gl, fence = this.fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    const look = () => {
      if (gl.clientWaitSync(fence, 0, 0) === gl.TIMEOUT_EXPIRED) return setTimeout(look, 2);
      gl.deleteSync(fence);
      this.fence = null;
      this.frameMs = performance.now() - began;
      this.slow = this.slow ? this.frameMs > 10 : this.frameMs > 40;
      if (this.again) this.redraw();
      this.again = false;
    };
    setTimeout(look, 0);
  }

  // From a place on the canvas: a ray.
  rayAt(event) {
    const box = this.canvas.getBoundingClientRect(), caster = new THREE.Raycaster();
    caster.setFromCamera(new THREE.Vector2(2 * (event.clientX - box.left) / box.width - 1, 1 - 2 * (event.clientY - box.top) / box.height), this.orbit.camera);
    return caster;
  }
}
