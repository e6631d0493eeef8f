// One square a sphere, which touches it where it is nearest to the eye and is as wide as it looks. Four vertices belong
// to a sphere, by their number: drawing one square as many instances is slow on most renderers.
precision highp float;
precision highp sampler2D;
uniform mat4 viewMatrix, projectionMatrix;
uniform sampler2D balls;  // centre and radius, 1024 a row
out vec3 onRay;
flat out vec4 sphere;
flat out vec3 name;

void main() {
  int i = gl_VertexID >> 2, k = gl_VertexID & 3;
  vec2 corner = vec2(k == 1 || k == 2 ? 1.0 : -1.0, k >= 2 ? 1.0 : -1.0);
  vec4 ball = texelFetch(balls, ivec2(i & 1023, i >> 10), 0);
  name = vec3(i & 255, i >> 8 & 255, i >> 16) / 255.0;
  vec3 c = (viewMatrix * vec4(ball.xyz, 1.0)).xyz;
  float r = ball.w, distanceSq = dot(c, c);
  sphere = vec4(c, r);
  onRay = vec3(0.0);
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  if (distanceSq < 1.1 * r * r) return;  // the eye is in it, or nearly: outside of what is seen
  float d = sqrt(distanceSq);
  vec3 ahead = c / d;
  vec3 right = normalize(cross(ahead, vec3(0.0, 1.0, 0.0))), up = cross(right, ahead);
  float halfWidth = (d - r) * r / sqrt(distanceSq - r * r);
  onRay = ahead * (d - r) + (right * corner.x + up * corner.y) * halfWidth;
  gl_Position = projectionMatrix * vec4(onRay, 1.0);
}
