// What is drawn on the body, and what of it is dragged: the axis or the up direction, the contact, the water line, both centres of
// mass.
import {colours} from './scene.js';

const vector = list => new THREE.Vector3(...list);

// A solid that is seen through the body, too, fainter.
function grip(geometry, colour) {
  const group = new THREE.Group();
  for (const [depthTest, opacity] of [[false, 0.45], [true, 1]]) {
    const mesh = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({color: colour, transparent: true, opacity, depthTest, depthWrite: false}));
    mesh.renderOrder = 6;
    group.add(mesh);
  }
  return group;
}

// A disc of four quarters, as drawings mark a centre of mass.
function centre(colour) {
  const canvas = Object.assign(document.createElement('canvas'), {width: 64, height: 64}), pen = canvas.getContext('2d');
  pen.translate(32, 32);
  pen.fillStyle = '#fff';
  pen.beginPath();
  pen.arc(0, 0, 28, 0, 7);
  pen.fill();
  pen.fillStyle = pen.strokeStyle = colour;
  pen.lineWidth = 7;
  pen.stroke();
  for (const from of [0, Math.PI]) {
    pen.beginPath();
    pen.moveTo(0, 0);
    pen.arc(0, 0, 26, from, from + Math.PI / 2);
    pen.fill();
  }
  const sprite = new THREE.Sprite(new THREE.SpriteMaterial({map: new THREE.CanvasTexture(canvas), depthTest: false, transparent: true}));
  sprite.renderOrder = 7;
  return sprite;
}

export class Marks {
  // on: axis(direction), contact(point), water(height): called while one is dragged, with whether it still moves.
  constructor(scene, on) {
    this.scene = scene;
    this.on = on;
    this.rod = grip(new THREE.CylinderBufferGeometry(1, 1, 1, 12), colours.axis);
    this.tip = grip(new THREE.ConeBufferGeometry(1, 2.4, 24), colours.axis);
    this.foot = grip(new THREE.SphereBufferGeometry(1, 24, 16), colours.axis);
    this.solid = centre(colours.solid);
    this.part = centre(colours.part);
    this.water = new THREE.Mesh(new THREE.CircleBufferGeometry(1, 64),
      new THREE.MeshBasicMaterial({color: colours.water, transparent: true, opacity: 0.28, side: THREE.DoubleSide, depthWrite: false}));
    this.water.renderOrder = 4;
    this.level = grip(new THREE.SphereBufferGeometry(1, 24, 16), colours.water);
    this.principal = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({color: colours.part, depthTest: false, transparent: true, opacity: 0.75}));
    this.principal.renderOrder = 6;
    scene.marks.add(this.rod, this.tip, this.foot, this.solid, this.part, this.water, this.level, this.principal);
    scene.marks.visible = false;
    scene.onDraw.push(camera => this.place(camera));
    const canvas = scene.canvas;
    canvas.addEventListener('pointerdown', event => this.take(event), true);
    canvas.addEventListener('pointermove', event => this.move(event), true);
    for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, event => this.let(event), true);
  }

  show(answer) {
    this.answer = answer;
    this.scene.marks.visible = true;
    if (!this.held) {
      this.axis = vector(answer.axis).normalize();
      this.contact = vector(answer.contact);
    }
    this.solid.position.copy(vector(answer.solid.centre_of_mass_mm));
    this.part.visible = this.principal.visible = Boolean(answer.part);
    if (answer.part) this.part.position.copy(vector(answer.part.centre_of_mass_mm));
    const depth = answer.solid.quality.draft_mm;
    this.water.visible = this.level.visible = depth !== undefined && depth !== null;
    if (this.water.visible && this.held !== this.level) this.depth = depth;
    this.scene.redraw(Boolean(this.held));
  }

  // The sphere of directions: where it can be done, where not. Nothing: away with it.
  showMap(map) {
    this.scene.scene.remove(this.sphere);
    this.sphere = null;
    if (map) {
      const yes = new THREE.Color(colours.part), no = new THREE.Color(colours.never), radius = 1.5 * this.scene.orbit.radius, middle = this.scene.orbit.middle;
      const places = map.axes.flatMap(axis => vector(axis).multiplyScalar(radius).add(middle).toArray()), tints = map.ok.flatMap(ok => (ok ? yes : no).toArray());
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', new THREE.Float32BufferAttribute(places, 3));
      geometry.setAttribute('color', new THREE.Float32BufferAttribute(tints, 3));
      this.sphere = new THREE.Points(geometry, new THREE.PointsMaterial({size: 5, sizeAttenuation: false, vertexColors: THREE.VertexColors}));
      this.sphere.renderOrder = 3;
      this.scene.scene.add(this.sphere);
    }
    this.scene.redraw();
  }

  // Sizes that look the same from any distance.
  place(camera) {
    if (!this.answer) return;
    const radius = this.scene.orbit.radius, small = 0.02 * camera.position.distanceTo(this.scene.orbit.middle) * Math.tan(0.5 * camera.fov * Math.PI / 180) * 2;
    const ends = [0, 0].map((_, k) => this.contact.clone().addScaledVector(this.axis, k ? 1.6 * radius : 0));
    const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), this.axis);
    this.rod.position.copy(ends[0]).lerp(ends[1], 0.5);
    this.rod.scale.set(0.14 * small, ends[0].distanceTo(ends[1]), 0.14 * small);
    this.tip.position.copy(ends[1]);
    this.tip.scale.setScalar(0.75 * small);
    for (const object of [this.rod, this.tip]) object.quaternion.copy(turn);
    this.foot.position.copy(ends[0]);
    this.foot.scale.setScalar(0.55 * small);
    for (const sprite of [this.solid, this.part]) sprite.scale.setScalar(1.5 * small);
    if (this.part.visible) {
      const at = this.part.position, places = [];
      this.answer.part.principal_axes.forEach((axis, k) => {
        const along = vector(axis).multiplyScalar(0.5 * radius * (1 - 0.2 * k));
        places.push(...at.clone().sub(along).toArray(), ...at.clone().add(along).toArray());
      });
      this.principal.geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(places), 3));
    }
    if (this.water.visible) {
      const middle = this.scene.orbit.middle, at = this.contact.clone().addScaledVector(this.axis, this.depth);
      this.water.position.copy(middle).addScaledVector(this.axis, at.clone().sub(middle).dot(this.axis));
      this.water.scale.setScalar(1.25 * radius);
      this.water.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), this.axis);
      const right = new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, 0);
      this.level.position.copy(this.water.position).addScaledVector(right.addScaledVector(this.axis, -right.dot(this.axis)).normalize(), 1.1 * radius);
      this.level.scale.setScalar(0.55 * small);
    }
  }

  gripAt(event) {
    if (!this.scene.marks.visible) return null;
    const ray = this.scene.rayAt(event).ray, camera = this.scene.orbit.camera;
    const near = [this.tip, this.foot, this.level].filter(g => g.visible).map(g => {
      const far = g.position.distanceTo(camera.position);
      return [ray.distanceToPoint(g.position) / far, g];
    }).sort((a, b) => a[0] - b[0])[0];
    return near && near[0] < 0.016 ? near[1] : null;
  }

  take(event) {
    if (event.button > 0) return;
    this.held = this.gripAt(event);
    if (!this.held) return;
    event.preventDefault();
    this.scene.canvas.focus();
    this.scene.canvas.setPointerCapture(event.pointerId);
  }

  move(event) {
    if (!this.held) {
      this.scene.canvas.classList.toggle('grip', !event.buttons && Boolean(this.gripAt(event)));
      return;
    }
    event.stopPropagation();
    this.drag(this.scene.rayAt(event), true);
  }

  let(event) {
    if (!this.held) return;
    event.stopPropagation();
    this.drag(this.scene.rayAt(event), false);
    this.held = null;
  }

  drag(caster, moving) {
    const ray = caster.ray;
    if (this.held === this.tip) this.dragAxis(ray, moving);
    if (this.held === this.foot) this.dragContact(caster, moving);
    if (this.held === this.level) this.dragWater(ray, moving);
    this.scene.redraw(moving);
  }

  // The end of the axis goes on a sphere about the contact; beside it, to the sphere's place nearest to the ray.
  dragAxis(ray, moving) {
    const far = 1.6 * this.scene.orbit.radius;
    const at = ray.intersectSphere(new THREE.Sphere(this.contact, far), new THREE.Vector3()) ?? ray.closestPointToPoint(this.contact, new THREE.Vector3());
    this.axis = at.sub(this.contact).normalize();
    this.on.axis(this.axis, moving);
  }
  dragContact(caster, moving) {
    const hit = caster.intersectObject(this.scene.body)[0];
    if (hit) this.contact = hit.point;
    this.on.contact(this.contact, moving);
  }
  dragWater(ray, moving) {
    const camera = this.scene.orbit.camera, toEye = camera.position.clone().sub(this.water.position);
    const level = toEye.addScaledVector(this.axis, -toEye.dot(this.axis)).normalize();
    const hit = ray.intersectPlane(new THREE.Plane().setFromNormalAndCoplanarPoint(level, this.level.position), new THREE.Vector3());
    if (!hit) return;
    this.depth = hit.sub(this.contact).dot(this.axis);
    this.on.water(this.depth, moving);
  }
}
