// A camera that turns about the body: by mouse, touch and keys.

export class Orbit {
  // changed: called when the picture is another. Pointers that somebody else takes (handles) are left alone.
  constructor(canvas, changed) {
    this.canvas = canvas;
    this.changed = changed;
    this.camera = new THREE.PerspectiveCamera(28, 1, 1, 1000);
    this.middle = new THREE.Vector3();
    this.up = new THREE.Vector3(0, 0, 1);
    this.radius = 50;
    this.around = 0.75;
    this.above = 0.35;
    this.zoom = 1;
    this.shift = new THREE.Vector2();
    this.pointers = new Map();
    canvas.addEventListener('pointerdown', event => {
      if (event.defaultPrevented) return;
      canvas.setPointerCapture(event.pointerId);
      this.pointers.set(event.pointerId, event);
    });
    canvas.addEventListener('pointermove', event => this.drag(event));
    for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, event => this.pointers.delete(event.pointerId));
    canvas.addEventListener('wheel', event => {
      event.preventDefault();
      this.zoomBy(Math.exp(-0.0012 * event.deltaY));
    }, {passive: false});
    canvas.addEventListener('keydown', event => this.key(event));
    canvas.addEventListener('contextmenu', event => event.preventDefault());
  }

  drag(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const dx = event.clientX - before.clientX, dy = event.clientY - before.clientY;
    if (this.pointers.size > 1) {
      const [other] = [...this.pointers.values()].filter(p => p.pointerId !== event.pointerId);
      const far = p => Math.hypot(p.clientX - other.clientX, p.clientY - other.clientY);
      this.zoomBy(far(event) / Math.max(far(before), 1));
      this.shiftBy(dx / 2, dy / 2);
    } else if (event.buttons & 2 || event.shiftKey) {
      this.shiftBy(dx, dy);
    } else {
      this.turnBy(-0.008 * dx, 0.008 * dy);
    }
    this.pointers.set(event.pointerId, event);
  }

  key(event) {
    const turn = {ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1]}[event.key];
    const zoom = {'+': 1.1, '=': 1.1, '-': 1 / 1.1}[event.key];
    if (turn) this.turnBy(...turn);
    if (zoom) this.zoomBy(zoom);
    if (turn || zoom) event.preventDefault();
  }

  turnBy(around, above) {
    this.around += around;
    this.above = Math.min(Math.max(this.above + above, -1.5), 1.5);
    this.changed(true);
  }
  zoomBy(factor) {
    this.zoom = Math.min(Math.max(this.zoom * factor, 0.4), 3.2);  // the eye stays outside of the body
    this.changed(true);
  }
  shiftBy(dx, dy) {
    this.shift.add(new THREE.Vector2(-dx, dy).multiplyScalar(2 * this.radius / this.canvas.clientHeight / this.zoom));
    this.changed(true);
  }

  look(middle, radius, up) {
    this.middle.copy(middle);
    this.radius = radius;
    this.up.copy(up);
    this.changed(false);
  }

  // Two directions across `up`, always the same for it.
  base() {
    const other = Math.abs(this.up.x) < 0.9 ? new THREE.Vector3(1, 0, 0) : new THREE.Vector3(0, 1, 0);
    const x = other.sub(this.up.clone().multiplyScalar(other.dot(this.up))).normalize();
    return [x, this.up.clone().cross(x)];
  }
  // From the middle to the eye, level.
  outward() {
    const [x, y] = this.base();
    return x.multiplyScalar(Math.cos(this.around)).add(y.multiplyScalar(Math.sin(this.around)));
  }

  place() {
    const camera = this.camera, aspect = this.canvas.clientWidth / Math.max(this.canvas.clientHeight, 1);
    const fits = this.radius / Math.sin(0.5 * camera.fov * Math.PI / 180) / Math.min(1, aspect);
    const far = Math.max(1.02 * fits / this.zoom, 1.15 * this.radius);
    const eye = this.outward().multiplyScalar(Math.cos(this.above)).addScaledVector(this.up, Math.sin(this.above));
    camera.aspect = aspect;
    camera.near = Math.max(far - 2.5 * this.radius, 0.02 * far);
    camera.far = far + 4 * this.radius;
    camera.up.copy(this.up);
    camera.position.copy(this.middle).addScaledVector(eye, far);
    camera.lookAt(this.middle);
    camera.updateMatrixWorld();
    const right = new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, 0), top = new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, 1);
    camera.position.addScaledVector(right, this.shift.x).addScaledVector(top, this.shift.y);
    camera.updateMatrixWorld();
    camera.updateProjectionMatrix();
    return camera;
  }
}
