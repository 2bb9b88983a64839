// The body cut by one quadric, in three passes. Nothing is meshed: ten coefficients are all that changes.
//
//   count   every fragment of the offset surface and of the skin, added up without a depth test: along a view ray, how often
//           one enters less how often one leaves, nearer than each root of the quadric and than the cut. Above 0: inside.
//   walls   the offset surface where the quadric leaves a void
//   roots   over the whole picture: the quadric where it is inside the offset surface, and material where the cut meets it

const common = `
  precision highp float;
  uniform mat4 toBody;
  uniform vec4 q1;
  uniform vec3 q2, q3, middle, cutNormal;
  uniform float voidSign, cutAt;
  uniform bool hollow, cutting;
  const float never = 1e30;

  float quadric(vec3 X) {
    return q1.x + dot(q1.yzw, X) + dot(q2, vec3(X.x * X.y, X.y * X.z, X.x * X.z)) + dot(q3, X * X);
  }
  vec3 slope(vec3 X) {
    return q1.yzw + vec3(q2.x * X.y + q2.z * X.z, q2.x * X.x + q2.y * X.z, q2.y * X.y + q2.z * X.x) + 2.0 * q3 * X;
  }
  vec3 body(vec3 p) { return (toBody * vec4(p, 1.0)).xyz; }
  bool isVoid(vec3 p) { return hollow && voidSign * quadric(body(p)) >= 0.0; }
  bool isCutAway(vec3 p) { return cutting && dot(cutNormal, p) > cutAt; }

  // Where the ray meets the quadric, the nearer first. From a place near the body: far away digits would be lost.
  vec2 rootsAlong(vec3 eye, vec3 d) {
    if (!hollow) return vec2(never);
    float t0 = dot(middle - eye, d);
    vec3 X = body(eye + t0 * d), D = mat3(toBody) * d;
    float a = dot(q2, vec3(D.x * D.y, D.y * D.z, D.x * D.z)) + dot(q3, D * D), b = dot(slope(X), D), c = quadric(X);
    float under = b * b - 4.0 * a * c;
    if (under < 0.0) return vec2(never);
    float w = -0.5 * (b + (b < 0.0 ? -1.0 : 1.0) * sqrt(under));
    vec2 t = vec2(abs(a) < 1e-12 * abs(w) ? never : w / a, abs(w) < 1e-20 ? never : c / w);
    t = t0 + t;
    return t.x < t.y ? t : t.yx;
  }
  float cutAlong(vec3 eye, vec3 d) {
    float slant = dot(cutNormal, d);
    return cutting && abs(slant) > 1e-6 ? (cutAt - dot(cutNormal, eye)) / slant : never;
  }
  // Light from above the eye's left shoulder, and a little from everywhere.
  vec3 lit(vec3 colour, vec3 normal, vec3 d, mat4 view) {
    if (dot(normal, d) > 0.0) normal = -normal;
    vec3 n = normalize((view * vec4(normal, 0.0)).xyz);
    float key = max(dot(n, normalize(vec3(-0.45, 0.6, 0.66))), 0.0), fill = max(dot(n, normalize(vec3(0.7, -0.1, 0.5))), 0.0);
    float rim = pow(1.0 - abs(dot(normal, d)), 3.0);
    return colour * (0.42 + 0.55 * key + 0.16 * fill) + 0.06 * rim;
  }
`;

const meshVertex = `
  varying vec3 place, smoothed;
  void main() {
    place = (modelMatrix * vec4(position, 1.0)).xyz;
    smoothed = (modelMatrix * vec4(normal, 0.0)).xyz;
    gl_Position = projectionMatrix * viewMatrix * vec4(place, 1.0);
  }
`;

// Corners are smoothed, but for edges: there a smooth normal is far from the triangle's own.
const meshNormal = `
  varying vec3 place, smoothed;
  vec3 normalHere() {
    vec3 flat_ = normalize(cross(dFdx(place), dFdy(place))), n = normalize(smoothed);
    if (dot(n, flat_) < 0.0) flat_ = -flat_;
    return dot(n, flat_) > 0.8 ? n : flat_;
  }
`;

const screenVertex = `
  varying vec2 at;
  void main() { at = position.xy; gl_Position = vec4(position.xy, 0.0, 1.0); }
`;

export const counting = {
  vertexShader: meshVertex,
  fragmentShader: common + `
    varying vec3 place, smoothed;
    uniform bool isSkin;
    void main() {
      vec3 ray = place - cameraPosition;
      float t = length(ray), s = gl_FrontFacing ? 1.0 : -1.0, cut = cutAlong(cameraPosition, ray / t);
      if (isSkin) {
        gl_FragColor = vec4(0.0, 0.0, 0.0, t < cut ? s : 0.0);
      } else {
        vec2 roots = rootsAlong(cameraPosition, ray / t);
        gl_FragColor = vec4(t < roots.x ? s : 0.0, t < roots.y ? s : 0.0, t < cut ? s : 0.0, 0.0);
      }
    }`,
};

export const walls = {
  vertexShader: meshVertex,
  fragmentShader: common + meshNormal + `
    uniform vec3 colour;
    void main() {
      if (isCutAway(place) || !isVoid(place)) discard;
      gl_FragColor = vec4(lit(colour, normalHere(), normalize(place - cameraPosition), viewMatrix), 1.0);
    }`,
};

export const skin = {
  vertexShader: meshVertex,
  fragmentShader: common + meshNormal + `
    uniform vec3 colour;
    uniform float opacity;
    void main() {
      if (isCutAway(place)) discard;
      vec3 d = normalize(place - cameraPosition), n = normalHere();
      float edge = 1.0 - abs(dot(n, d));
      gl_FragColor = vec4(lit(colour, n, d, viewMatrix), opacity < 1.0 ? opacity * (0.35 + 1.6 * edge * edge) : 1.0);
    }`,
};

export const roots = {
  vertexShader: screenVertex,
  fragmentShader: common + `
    varying vec2 at;
    uniform sampler2D counts;
    uniform vec2 part;  // of the counts' width: where it begins, and how much of it
    uniform mat4 fromScreen, projection;
    uniform vec3 cavityColour, shellColour, interiorColour;

    void show(vec3 p, vec3 colour) {
      vec4 clip = projection * viewMatrix * vec4(p, 1.0);
      gl_FragDepthEXT = 0.5 * clip.z / clip.w + 0.5;
      gl_FragColor = vec4(colour, 1.0);
    }
    void main() {
      vec4 inside = texture2D(counts, vec2(part.x + part.y * (0.5 * at.x + 0.5), 0.5 * at.y + 0.5));
      if (max(max(inside.r, inside.g), inside.a) < 0.5) discard;
      vec4 far = fromScreen * vec4(at, 1.0, 1.0);
      vec3 d = normalize(far.xyz / far.w - cameraPosition);
      vec2 t = rootsAlong(cameraPosition, d);
      float cut = cutAlong(cameraPosition, d);
      if (cut > 0.0 && cut < never && dot(cutNormal, d) < 0.0 && inside.a > 0.5) {
        vec3 p = cameraPosition + cut * d;
        bool within = inside.b > 0.5;
        if (!(within && isVoid(p))) {
          show(p, within ? interiorColour : shellColour);
          return;
        }
      }
      for (int k = 0; k < 2; ++k) {
        float root = k == 0 ? t.x : t.y, count = k == 0 ? inside.r : inside.g;
        vec3 p = cameraPosition + root * d;
        if (root > 0.0 && root < never && count > 0.5 && !isCutAway(p)) {
          show(p, lit(cavityColour, normalize(transpose(mat3(toBody)) * slope(body(p))), d, viewMatrix));
          return;
        }
      }
      discard;
    }`,
};
