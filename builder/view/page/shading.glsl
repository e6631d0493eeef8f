// Light of a small studio that goes with the camera; view frame, unit vectors. Colours are squared for the sum of light
// and rooted for the display: a gamma of 2 costs a fraction of the exact one.
vec3 shaded(vec3 color, vec3 n, vec3 toEye, float gloss) {
  const vec3 key = vec3(-0.43, 0.66, 0.62);
  const vec3 fill = vec3(0.75, 0.05, 0.66);
  float lit = max(0.0, (dot(n, key) + 0.2) / 1.2);
  float filled = max(0.0, (dot(n, fill) + 0.5) / 1.5);
  vec3 sky = mix(vec3(0.30, 0.27, 0.25), vec3(0.46, 0.49, 0.54), 0.5 + 0.5 * n.y);
  vec3 light = sky + vec3(0.66, 0.63, 0.58) * lit + vec3(0.10, 0.12, 0.15) * filled;
  float shine = max(0.0, dot(n, normalize(key + toEye)));
  shine *= shine; shine *= shine; shine *= shine; shine *= shine; shine *= shine;
  return sqrt(clamp(color * color * light + gloss * shine, 0.0, 1.0));
}
