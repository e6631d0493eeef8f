// The mean of all samples so far.
precision highp float;
uniform sampler2D before, now;
uniform float weight;  // of the new one
in vec2 uv;
out vec4 color;
void main() {
  color = mix(texture(before, uv), texture(now, uv), weight);
}
