// A lighter surface in place of one of many triangles, for as long as the picture moves.

// Corners that lie in one cell of a grid become their mean; triangles that lose their area go. A closed surface stays closed: along
// a view ray one still enters as often as one leaves, which is what the shaders count.
export function lighter(geometry, cells = 44) {
  const places = geometry.attributes.position.array, triangles = geometry.index.array, box = geometry.boundingBox;
  const size = box.getSize(new THREE.Vector3()), cell = Math.max(size.x, size.y, size.z) / cells || 1;
  const count = places.length / 3, cellOf = new Uint32Array(count), numbers = new Map(), sums = [];
  for (let i = 0; i < count; ++i) {
    const x = places[3 * i], y = places[3 * i + 1], z = places[3 * i + 2];
    const key = (Math.floor((x - box.min.x) / cell) * 128 + Math.floor((y - box.min.y) / cell)) * 128 + Math.floor((z - box.min.z) / cell);
    let number = numbers.get(key);
    if (number === undefined) {
      numbers.set(key, number = numbers.size);
      sums.push(0, 0, 0, 0);
    }
    cellOf[i] = number;
    sums[4 * number] += x;
    sums[4 * number + 1] += y;
    sums[4 * number + 2] += z;
    ++sums[4 * number + 3];
  }
  const means = new Float32Array(3 * numbers.size), left = [];
  for (let n = 0; n < numbers.size; ++n) for (let k = 0; k < 3; ++k) means[3 * n + k] = sums[4 * n + k] / sums[4 * n + 3];
  for (let t = 0; t < triangles.length; t += 3) {
    const a = cellOf[triangles[t]], b = cellOf[triangles[t + 1]], c = cellOf[triangles[t + 2]];
    if (a !== b && b !== c && c !== a) left.push(a, b, c);
  }
  const light = new THREE.BufferGeometry();
  light.setAttribute('position', new THREE.BufferAttribute(means, 3));
  light.setIndex(left);
  light.computeVertexNormals();
  light.boundingBox = geometry.boundingBox;
  light.boundingSphere = geometry.boundingSphere;
  return light;
}
