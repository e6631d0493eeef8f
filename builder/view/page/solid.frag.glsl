precision highp float;
uniform vec3 stone, mark, ink;
uniform float wire;  // 0: no edges
in vec3 onRay;
in vec3 n;
in vec3 weights;
flat in vec4 folds;
out vec4 color;

void main() {
  vec3 ray = normalize(onRay);
  vec3 normal = normalize(n);
  if (dot(normal, ray) > 0.0) normal = -normal;
  vec3 albedo = mix(stone, mark, folds.w);
  vec3 c = shaded(albedo, normal, -ray, 0.05);
  if (wire > 0.0) {
    vec3 width = max(fwidth(weights), 1e-6);
    vec3 pixels = weights / width;
    vec3 strength = mix(vec3(0.16), vec3(0.5), folds.xyz);
    vec3 line = (1.0 - clamp(pixels - 0.2, 0.0, 1.0)) * strength;
    // Where triangles are but a few pixels, lines would make the surface grey.
    float shown = smoothstep(0.0, 1.0, 0.16 / max(width.x, max(width.y, width.z)) - 0.35);
    c = mix(c, ink, max(line.x, max(line.y, line.z)) * shown * wire);
  }
  color = vec4(c, 1.0);
}
