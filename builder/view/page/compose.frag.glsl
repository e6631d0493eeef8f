// Lights the spheres and lays them over the mesh over the ground of the page, each darkened where it is hemmed in.
precision highp float;
precision highp sampler2D;
uniform sampler2D solidColor, solidDepth, sphereName, sphereDepth, balls, looks;
uniform mat4 viewMatrix, projectionMatrix;
uniform vec3 ramp[6];
uniform vec3 alarm, alarmLink, plain;
uniform vec2 size;        // pixels
uniform float veil;       // opacity of spheres over the mesh
uniform float chosenVeil; // that of chosen ones
uniform float reach;      // of the darkening, view unit
uniform int taps;         // of each layer; 0: none
uniform float turn;       // of this sample, radians
uniform vec3 above, below;
in vec2 uv;
out vec4 color;

const float kFar = 1.0;

vec3 placeOf(vec2 at, float depth) {
  float z = -projectionMatrix[3][2] / (projectionMatrix[2][2] + 2.0 * depth - 1.0);
  vec2 ndc = 2.0 * at - 1.0;
  return vec3((ndc.x + projectionMatrix[2][0]) * -z / projectionMatrix[0][0],
              (ndc.y + projectionMatrix[2][1]) * -z / projectionMatrix[1][1], z);
}

vec3 nearer(vec3 a, vec3 b) { return abs(a.z) < abs(b.z) ? a : b; }

vec3 normalAt(sampler2D depths, vec3 p) {
  vec2 x = vec2(1.0 / size.x, 0.0), y = vec2(0.0, 1.0 / size.y);
  vec3 dx = nearer(placeOf(uv + x, texture(depths, uv + x).r) - p, p - placeOf(uv - x, texture(depths, uv - x).r));
  vec3 dy = nearer(placeOf(uv + y, texture(depths, uv + y).r) - p, p - placeOf(uv - y, texture(depths, uv - y).r));
  return normalize(cross(dx, dy));
}

// How open a surface is at a pixel: 1 in the free, less in hollows. Points of a disc around it that rise above its plane
// hem it in.
float openness(sampler2D depths, vec3 p, vec3 n) {
  vec2 radius = 0.5 * reach * vec2(projectionMatrix[0][0], projectionMatrix[1][1]) / -p.z;
  float hemmed = 0.0;
  for (int i = 0; i < taps; ++i) {
    float share = (float(i) + 0.5) / float(taps);
    float angle = turn + 2.39996 * float(i) + 6.2832 * fract(52.9829 * fract(dot(gl_FragCoord.xy, vec2(0.06711, 0.00584))));
    vec2 at = uv + radius * sqrt(share) * vec2(cos(angle), sin(angle));
    vec3 to = placeOf(at, texture(depths, at).r) - p;
    float far = dot(to, to);
    hemmed += max(0.0, dot(to, n) - 0.02 * reach) / (sqrt(far) + 1e-6) * smoothstep(4.0, 1.0, far / (reach * reach));
  }
  return 1.0 - min(0.85, 1.5 * hemmed / float(taps));
}

vec3 errorColor(float share) {
  float at = clamp(share, 0.0, 1.0) * 5.0;
  int i = min(int(at), 4);
  return mix(ramp[i], ramp[i + 1], at - float(i));
}

vec3 lookColor(float look) {
  if (look < 0.0) return plain;
  if (look > 1.5) return look > 2.5 ? alarm : alarmLink;
  return errorColor(look);
}

vec4 sphereAt(float depth) {
  vec3 name = 255.0 * texture(sphereName, uv).rgb + 0.5;
  int i = int(name.r) | int(name.g) << 8 | int(name.b) << 16;
  ivec2 at = ivec2(i & 1023, i >> 10);
  vec4 ball = texelFetch(balls, at, 0);
  vec2 look = texelFetch(looks, at, 0).rg;
  vec3 p = placeOf(uv, depth), ray = normalize(p);
  vec3 n = normalize(p - (viewMatrix * vec4(ball.xyz, 1.0)).xyz);
  float facing = -dot(n, ray);
  vec3 c = shaded(lookColor(look.x), n, -ray, 0.12);
  c *= mix(0.72, 1.0, smoothstep(0.0, 0.45, facing));  // a soft line around every sphere
  if (taps > 0) c *= mix(0.55 * c, vec3(1.0), openness(sphereDepth, p, n));
  return vec4(c, look.y > 0.5 ? chosenVeil : veil);
}

void main() {
  float solid = texture(solidDepth, uv).r, spheres = texture(sphereDepth, uv).r;
  vec2 fromMiddle = uv - vec2(0.5, 0.55);
  vec3 c = mix(below, above, smoothstep(0.75, 0.0, length(fromMiddle)));
  if (solid < kFar) {
    c = texture(solidColor, uv).rgb;
    if (taps > 0) {
      vec3 p = placeOf(uv, solid);
      c *= mix(vec3(0.36, 0.34, 0.38), vec3(1.0), openness(solidDepth, p, normalAt(solidDepth, p)));
    }
  }
  if (spheres < solid) {
    vec4 over = sphereAt(spheres);
    c = mix(c, over.rgb, over.a);
  }
  color = vec4(c, 1.0);
}
