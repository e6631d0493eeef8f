// The sphere's number and the depth at which the ray through the pixel meets it; its light is left to compose.frag,
// because most of what is drawn here is hidden later.
precision highp float;
uniform mat4 projectionMatrix;
in vec3 onRay;
flat in vec4 sphere;
flat in vec3 name;
#ifdef GL_EXT_conservative_depth
layout(depth_greater) out float gl_FragDepth;
#endif
out vec4 color;

void main() {
  float perLength = 1.0 / dot(onRay, onRay);
  float along = dot(onRay, sphere.xyz) * perLength;
  vec3 beside = onRay * along - sphere.xyz;  // from the centre to the ray
  float halfChordSq = sphere.w * sphere.w - dot(beside, beside);
  if (halfChordSq < 0.0) discard;
  float z = onRay.z * (along - sqrt(halfChordSq * perLength));
  gl_FragDepth = 0.5 - 0.5 * (projectionMatrix[2][2] + projectionMatrix[3][2] / z);
  color = vec4(name, 1.0);
}
