// The solid and the part in motion, beside each other. What moves is the eye, the other way round: then the shaders need not know.

const slower = 5;  // than it is

// The motion of the model, about its contact, that turns body axes by q.
function moved(said, q) {
  const [x, y, z] = said.rotation, o = said.origin;
  const toBody = new THREE.Matrix4().set(...x, 0, ...y, 0, ...z, 0, 0, 0, 0, 1);
  const about = new THREE.Matrix4().makeTranslation(...o), back = new THREE.Matrix4().makeTranslation(...o.map(v => -v));
  return about.multiply(new THREE.Matrix4().getInverse(toBody)).multiply(new THREE.Matrix4().makeRotationFromQuaternion(q)).multiply(toBody).multiply(back);
}

// At a time: the attitude of the body, and the tilt of the ground.
function attitude(said, body, seconds) {
  if (body.attitudes) {
    const all = body.attitudes, k = Math.min(Math.max(seconds / body.seconds * (all.length - 1), 0), all.length - 1.0001), i = Math.floor(k);
    return new THREE.Quaternion(...all[i]).slerp(new THREE.Quaternion(...all[i + 1]), k - i);
  }
  const {azimuth_degrees: azimuth, angle_degrees: angle} = body.topples, way = azimuth * Math.PI / 180, tilt = Math.min(12 * seconds, angle);
  const axis = new THREE.Vector3(-Math.sin(way), Math.cos(way), 0);
  const fall = Math.max(12 * seconds - angle, 0);
  return new THREE.Quaternion().setFromAxisAngle(axis, (tilt + Math.min(fall * fall, 60)) * Math.PI / 180);
}

export class Motion {
  constructor(scene) {
    this.scene = scene;
    this.said = null;
    this.ground = new THREE.Mesh(new THREE.RingBufferGeometry(0.02, 1, 96, 6),
      new THREE.MeshBasicMaterial({color: '#8a96a3', wireframe: true, transparent: true, opacity: 0.35}));
    this.ground.visible = false;
    this.ground.matrixAutoUpdate = false;
    scene.scene.add(this.ground);
  }

  get playing() { return Boolean(this.said); }

  play(said) {
    this.said = said;
    this.began = performance.now();
    this.length = said.part.attitudes ? Math.max(said.part.seconds, 0.1) : 12;
    this.scene.redraw(true);
  }
  end() {
    this.said = null;
    this.ground.visible = false;
    this.scene.redraw();
  }

  // In place of the scene's own drawing. draw(camera, left, width, hollow)
  draw(camera, draw) {
    const {said} = this, played = (performance.now() - this.began) / 1000, seconds = said.part.attitudes ? played / slower : played % this.length;
    if (said.part.attitudes && seconds > this.length) return this.end();
    const rest = camera.matrixWorld.clone();
    this.ground.visible = true;
    ['solid', 'part'].forEach((name, side) => {
      const body = moved(said, attitude(said, said[name], seconds)), seen = new THREE.Matrix4().getInverse(body);
      camera.matrix.multiplyMatrices(seen, rest);
      camera.matrix.decompose(camera.position, camera.quaternion, camera.scale);
      camera.updateMatrixWorld();
      const up = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), new THREE.Vector3(...said.rotation[2]));
      const still = new THREE.Matrix4().compose(new THREE.Vector3(...said.origin), up, new THREE.Vector3(1, 1, 1).multiplyScalar(1.3 * this.scene.orbit.radius));
      this.ground.matrix.multiplyMatrices(said.part.attitudes ? seen : new THREE.Matrix4(), still);
      draw(camera, side, name === 'part');
    });
    this.scene.redraw(true);
  }
}
