precision highp float;
uniform sampler2D picture;
in vec2 uv;
out vec4 color;
void main() {
  // A grain of half a step keeps soft gradients free of bands.
  float grain = fract(sin(dot(gl_FragCoord.xy, vec2(12.9898, 78.233))) * 43758.5453) - 0.5;
  color = vec4(texture(picture, uv).rgb + grain / 255.0, 1.0);
}
