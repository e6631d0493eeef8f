// The outline of a sphere, over everything: a line where it ends, and a breath of colour within.
precision highp float;
uniform vec3 ink;
uniform float lineWidth;  // pixels
uniform float haze;
in vec3 onRay;
flat in vec4 sphere;
out vec4 color;

void main() {
  vec3 ray = normalize(onRay);
  vec3 beside = ray * dot(ray, sphere.xyz) - sphere.xyz;
  float q = length(beside) / sphere.w;
  float pixel = max(fwidth(q), 1e-6);
  float inside = clamp((1.0 - q) / pixel, 0.0, 1.0);
  float line = inside * clamp(lineWidth - (1.0 - q) / pixel, 0.0, 1.0);
  float veil = inside * haze * pow(q, 4.0);
  color = vec4(ink, max(line, veil));
}
