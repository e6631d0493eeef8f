precision highp float;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform mat3 normalMatrix;
in vec3 position;
in vec3 normal;
in vec4 edges;  // of the edges opposite to the corners: 1 where the surface folds; and 1 for a marked triangle
out vec3 onRay;
out vec3 n;
out vec3 weights;
flat out vec4 folds;

void main() {
  vec4 p = modelViewMatrix * vec4(position, 1.0);
  onRay = p.xyz;
  n = normalMatrix * normal;
  int k = gl_VertexID % 3;
  weights = vec3(k == 0, k == 1, k == 2);
  folds = edges;
  gl_Position = projectionMatrix * p;
}
