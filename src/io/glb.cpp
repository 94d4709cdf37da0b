// GLB, the binary container of glTF 2.0 (Khronos, 2017; registry.khronos.org/glTF/specs/2.0): its triangles in place.
//
// Taken is the default scene (else the first, else all root nodes, else every mesh once): each node with a mesh gives
// that mesh's triangles under the node's global transform, the triangles turned over where it mirrors. Primitives are
// triangles, strips or fans; points and lines are passed over. Positions are floats or, as in KHR_mesh_quantization,
// integers, normalised or not. Primitives of one mesh that share a position accessor share its vertices. A triangle's
// material is the primitive's plus one, or 0. Skins and morph targets are not applied.
// A node tree that is no tree (two parents, a cycle through a root) is a syntax error.
#include "base/vector.h"
#include "io/faces.h"
#include "io/glb_document.h"
#include "io/readers.h"

namespace isolod {
inline namespace v1 {

namespace {

/// Three rows of a 4 by 4 matrix whose last row is 0 0 0 1.
struct Affine {
  double m[3][4];

  Vec3 apply(Vec3 p) const { return {row(0, p), row(1, p), row(2, p)}; }
  double row(int r, Vec3 p) const { return m[r][0] * p.x + m[r][1] * p.y + m[r][2] * p.z + m[r][3]; }
  bool mirrors() const {
    const Vec3 x = {m[0][0], m[1][0], m[2][0]}, y = {m[0][1], m[1][1], m[2][1]}, z = {m[0][2], m[1][2], m[2][2]};
    return dot(cross(x, y), z) < 0;
  }
  bool is_identity() const {
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 4; ++c) {
        if (m[r][c] != (r == c ? 1 : 0)) return false;
      }
    }
    return true;
  }
};

constexpr Affine identity_transform = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

Affine combine(const Affine& outer, const Affine& inner) {
  if (outer.is_identity()) return inner;
  if (inner.is_identity()) return outer;
  Affine product;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c) {
      const double* row = outer.m[r];
      const double sum = row[0] * inner.m[0][c] + row[1] * inner.m[1][c] + row[2] * inner.m[2][c];
      product.m[r][c] = c == 3 ? sum + row[3] : sum;
    }
  }
  return product;
}

/// Translation, rotation (a quaternion x y z w) and scale.
Affine from_parts(const double t[3], const double q[4], const double s[3]) {
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  return {{{(1 - 2 * (y * y + z * z)) * s[0], 2 * (x * y - z * w) * s[1], 2 * (x * z + y * w) * s[2], t[0]},
           {2 * (x * y + z * w) * s[0], (1 - 2 * (x * x + z * z)) * s[1], 2 * (y * z - x * w) * s[2], t[1]},
           {2 * (x * z - y * w) * s[0], 2 * (y * z + x * w) * s[1], (1 - 2 * (x * x + y * y)) * s[2], t[2]}}};
}

struct GlbPrimitive {
  GlbNumbers points;
  GlbNumbers indices;
  bool is_indexed;
  bool owns_points;            ///< the first of its mesh that uses this accessor
  std::uint32_t mode;          ///< 4 triangles, 5 strip, 6 fan
  std::uint32_t material;      ///< 0 for none
  std::uint64_t first_vertex;  ///< in its mesh
};

struct GlbMesh {
  Span<GlbPrimitive> primitives;
  std::uint64_t vertices, triangles;
};

/// Calls `emit(a, b, c)` with the vertices, within the accessor, of each triangle. All indices are known to be good.
template <class Emit>
void each_triangle(const GlbPrimitive& primitive, Emit emit) {
  const std::size_t count = primitive.is_indexed ? primitive.indices.count : primitive.points.count;
  const auto index = [&](std::size_t i) {
    return primitive.is_indexed ? primitive.indices.index(i) : static_cast<std::uint32_t>(i);
  };
  if (primitive.mode == 4) {
    for (std::size_t i = 0; i + 3 <= count; i += 3) emit(index(i), index(i + 1), index(i + 2));
    return;
  }
  TriangleStrip strip;
  for (std::size_t i = 0; i < count; ++i) {
    if (primitive.mode == 5) {
      if (strip.add(index(i))) emit(strip.a, strip.b, strip.c);
    } else if (i >= 2) {
      const std::uint32_t a = index(0), b = index(i - 1), c = index(i);
      if (a != b && b != c && c != a) emit(a, b, c);
    }
  }
}

/// Reads the meshes' primitives, once, however many nodes use them.
class GlbMeshes {
 public:
  Status read(const GlbDocument& document, Arena& arena) {
    const Json& json = document.json();
    Span<std::uint32_t> tokens;
    ISOLOD_TRY(json.items(json.find(Json::root, "meshes"), tokens, arena));
    ISOLOD_TRY(arena.scratch(tokens.count, meshes_));
    ISOLOD_TRY(arena.scratch(document.accessor_count(), last_use_));
    for (Use& use : last_use_) use = {UINT32_MAX, 0};
    for (std::size_t i = 0; i < tokens.count; ++i) {
      ISOLOD_TRY(read_mesh_token(document, tokens[i], static_cast<std::uint32_t>(i), arena));
    }
    return {};
  }

  Span<const GlbMesh> meshes() const { return meshes_; }
  bool has_materials() const { return has_materials_; }

 private:
  /// The mesh that used an accessor last, and where its vertices are there.
  struct Use {
    std::uint32_t mesh;
    std::uint64_t first_vertex;
  };

  Status read_mesh_token(const GlbDocument& document, std::uint32_t token, std::uint32_t number, Arena& arena) {
    const Json& json = document.json();
    GlbMesh mesh = {};
    Span<std::uint32_t> tokens;
    ISOLOD_TRY(json.items(json.find(token, "primitives"), tokens, arena));
    ISOLOD_TRY(arena.scratch(tokens.count, mesh.primitives));
    std::size_t kept = 0;
    for (const std::uint32_t t : tokens) {
      std::uint64_t mode = 0;
      ISOLOD_TRY(json.count(json.find(t, "mode"), 4, mode));
      const std::uint32_t position = json.find(json.find(t, "attributes"), "POSITION");
      if (mode > 6) return json.fail_at(Status::syntax_error, t);
      if (mode < 4 || position == Json::missing) continue;
      GlbPrimitive& primitive = mesh.primitives[kept++];
      primitive = {};
      primitive.mode = static_cast<std::uint32_t>(mode);
      ISOLOD_TRY(read_primitive(document, t, position, primitive));
      ISOLOD_TRY(place_points(document, position, number, mesh, primitive));
      each_triangle(primitive, [&](std::uint32_t, std::uint32_t, std::uint32_t) { ++mesh.triangles; });
      ISOLOD_TRY(check_count(mesh.triangles));
    }
    mesh.primitives = mesh.primitives.first(kept);
    meshes_[number] = mesh;
    return {};
  }

  Status read_primitive(const GlbDocument& document, std::uint32_t token, std::uint32_t position,
                        GlbPrimitive& primitive) {
    const Json& json = document.json();
    std::uint64_t accessor = 0, material = 0;
    ISOLOD_TRY(json.count(position, 0, accessor));
    ISOLOD_TRY(document.locate(accessor, position, "VEC3", primitive.points));
    const std::uint32_t material_token = json.find(token, "material");
    ISOLOD_TRY(json.count(material_token, 0, material));
    if (material >= UINT32_MAX) return json.fail_at(Status::syntax_error, material_token);
    primitive.material = material_token == Json::missing ? 0 : static_cast<std::uint32_t>(material + 1);
    has_materials_ = has_materials_ || primitive.material != 0;
    const std::uint32_t indices = json.find(token, "indices");
    if (indices == Json::missing) return {};
    primitive.is_indexed = true;
    ISOLOD_TRY(json.count(indices, 0, accessor));
    ISOLOD_TRY(document.locate(accessor, indices, "SCALAR", primitive.indices));
    const GlbNumbers& numbers = primitive.indices;
    if (numbers.is_float || numbers.is_signed) return json.fail_at(Status::syntax_error, indices);
    for (std::size_t i = 0; i < numbers.count; ++i) {
      if (numbers.index(i) < primitive.points.count) continue;
      return fail(Status::index_out_of_range, Element::byte, document.offset_of(numbers.data + i * numbers.stride));
    }
    return {};
  }

  Status place_points(const GlbDocument& document, std::uint32_t position, std::uint32_t number, GlbMesh& mesh,
                      GlbPrimitive& primitive) {
    std::uint64_t accessor = 0;
    ISOLOD_TRY(document.json().count(position, 0, accessor));
    Use& use = last_use_[accessor];
    primitive.owns_points = use.mesh != number;
    if (primitive.owns_points) {
      use = {number, mesh.vertices};
      mesh.vertices += primitive.points.count;
    }
    primitive.first_vertex = use.first_vertex;
    return {};
  }

  Span<GlbMesh> meshes_;
  Span<Use> last_use_;
  bool has_materials_ = false;
};

/// A mesh in its place.
struct GlbInstance {
  std::uint32_t mesh;
  Affine transform;
};

/// The scene's nodes, depth first, as instances.
class GlbScene {
 public:
  GlbScene(const Json& json, std::size_t mesh_count) : json_(json), mesh_count_(mesh_count) {}

  Status read(Arena& arena) {
    ISOLOD_TRY(json_.items(json_.find(Json::root, "nodes"), tokens_, arena));
    const bool has_nodes = tokens_.count > 0;
    ISOLOD_TRY(arena.scratch(has_nodes ? tokens_.count : mesh_count_, instances_));
    if (!has_nodes) {
      for (std::uint32_t m = 0; m < mesh_count_; ++m) instances_[count_++] = {m, identity_transform};
      return {};
    }
    ISOLOD_TRY(arena.scratch(tokens_.count, nodes_));
    ISOLOD_TRY(link());
    std::uint32_t list = Json::missing;
    ISOLOD_TRY(find_scene(list));
    if (list == Json::missing) {
      for (std::uint32_t n = 0; n < nodes_.count; ++n) {
        if (nodes_[n].parent == Json::missing) ISOLOD_TRY(walk(n));
      }
      return {};
    }
    for (std::uint32_t t = json_.first(list); t != Json::missing; t = json_.after(t, list)) {
      std::uint32_t root = 0;
      ISOLOD_TRY(node_number(t, root));
      const bool is_root = nodes_[root].parent == Json::missing && !nodes_[root].visited;
      if (!is_root) return json_.fail_at(Status::syntax_error, t);
      ISOLOD_TRY(walk(root));
    }
    return {};
  }

  Span<const GlbInstance> instances() const { return instances_.first(count_); }

 private:
  struct Node {
    std::uint32_t parent, child, sibling;
    bool visited;
    Affine world;
  };

  Status node_number(std::uint32_t token, std::uint32_t& number) const {
    std::uint64_t value = 0;
    ISOLOD_TRY(json_.count(token, 0, value));
    if (value >= tokens_.count) return json_.fail_at(Status::syntax_error, token);
    number = static_cast<std::uint32_t>(value);
    return {};
  }

  /// Parents, first children and siblings. No node gets two parents.
  Status link() {
    for (Node& node : nodes_) node = {Json::missing, Json::missing, Json::missing, false, identity_transform};
    for (std::uint32_t n = 0; n < nodes_.count; ++n) {
      const std::uint32_t children = json_.find(tokens_[n], "children");
      std::uint32_t last = Json::missing;
      for (std::uint32_t t = json_.first(children); t != Json::missing; t = json_.after(t, children)) {
        std::uint32_t child = 0;
        ISOLOD_TRY(node_number(t, child));
        if (nodes_[child].parent != Json::missing) return json_.fail_at(Status::syntax_error, t);
        nodes_[child].parent = n;
        (last == Json::missing ? nodes_[n].child : nodes_[last].sibling) = child;
        last = child;
      }
    }
    return {};
  }

  /// The list of the scene's roots; missing where there is no scene.
  Status find_scene(std::uint32_t& list) const {
    const std::uint32_t scenes = json_.find(Json::root, "scenes"), named = json_.find(Json::root, "scene");
    std::uint64_t wanted = 0;
    ISOLOD_TRY(json_.count(named, 0, wanted));
    std::uint32_t scene = json_.first(scenes);
    for (; wanted > 0 && scene != Json::missing; --wanted) scene = json_.after(scene, scenes);
    if (scene == Json::missing && named != Json::missing) return json_.fail_at(Status::syntax_error, named);
    list = json_.find(scene, "nodes");
    if (scene != Json::missing && list == Json::missing) list = scene;  // a scene without nodes: nothing
    return {};
  }

  /// A root and all below it: down to the first child, else to the sibling, else up. A root has no parent and every
  /// other node one, so this is a tree and ends.
  Status walk(std::uint32_t root) {
    std::uint32_t at = root;
    for (;;) {
      ISOLOD_TRY(visit(at));
      if (nodes_[at].child != Json::missing) {
        at = nodes_[at].child;
        continue;
      }
      while (at != root && nodes_[at].sibling == Json::missing) at = nodes_[at].parent;
      if (at == root) return {};
      at = nodes_[at].sibling;
    }
  }

  Status visit(std::uint32_t n) {
    Node& node = nodes_[n];
    node.visited = true;
    Affine local = identity_transform;
    ISOLOD_TRY(read_transform(tokens_[n], local));
    node.world = node.parent == Json::missing ? local : combine(nodes_[node.parent].world, local);
    const std::uint32_t named = json_.find(tokens_[n], "mesh");
    if (named == Json::missing) return {};
    std::uint64_t mesh = 0;
    ISOLOD_TRY(json_.count(named, 0, mesh));
    if (mesh >= mesh_count_) return json_.fail_at(Status::syntax_error, named);
    instances_[count_++] = {static_cast<std::uint32_t>(mesh), node.world};
    return {};
  }

  /// `count` numbers of a member that is an array of as many, if it is there.
  Status read_numbers(std::uint32_t node, const char* key, double* to, std::size_t count) const {
    const std::uint32_t array = json_.find(node, key);
    if (array == Json::missing) return {};
    std::size_t read = 0;
    for (std::uint32_t t = json_.first(array); t != Json::missing; t = json_.after(t, array)) {
      if (read == count) return json_.fail_at(Status::syntax_error, t);
      ISOLOD_TRY(json_.number(t, 0, to[read++]));
    }
    return read == count ? Status() : json_.fail_at(Status::syntax_error, array);
  }

  Status read_transform(std::uint32_t node, Affine& transform) const {
    if (json_.find(node, "matrix") != Json::missing) {
      double columns[16];
      ISOLOD_TRY(read_numbers(node, "matrix", columns, 16));
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 4; ++c) transform.m[r][c] = columns[4 * c + r];
      }
      return {};
    }
    double translation[3] = {0, 0, 0}, rotation[4] = {0, 0, 0, 1}, scale[3] = {1, 1, 1};
    ISOLOD_TRY(read_numbers(node, "translation", translation, 3));
    ISOLOD_TRY(read_numbers(node, "rotation", rotation, 4));
    ISOLOD_TRY(read_numbers(node, "scale", scale, 3));
    transform = from_parts(translation, rotation, scale);
    return {};
  }

  const Json& json_;
  std::size_t mesh_count_;
  Span<std::uint32_t> tokens_;
  Span<Node> nodes_;
  Span<GlbInstance> instances_;
  std::size_t count_ = 0;
};

/// Writes instances one after the other to the result.
class GlbFiller {
 public:
  explicit GlbFiller(LoadedMesh& mesh) : mesh_(mesh) {}

  Status begin(std::uint64_t vertices, std::uint64_t triangles, bool materials, Arena& arena) {
    ISOLOD_TRY(check_count(vertices));
    ISOLOD_TRY(check_count(triangles));
    ISOLOD_TRY(arena.result(static_cast<std::size_t>(3 * vertices), mesh_.positions));
    ISOLOD_TRY(arena.result(static_cast<std::size_t>(3 * triangles), mesh_.triangles));
    return materials ? arena.result(static_cast<std::size_t>(triangles), mesh_.triangle_materials) : Status();
  }

  void add(const GlbMesh& mesh, const Affine& transform) {
    const bool moves = !transform.is_identity(), mirrors = transform.mirrors();
    for (const GlbPrimitive& primitive : mesh.primitives) {
      if (primitive.owns_points) add_points(primitive, moves ? &transform : nullptr);
      const auto first = static_cast<std::uint32_t>(vertices_ + primitive.first_vertex);
      each_triangle(primitive, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        std::uint32_t* to = mesh_.triangles.data + 3 * triangles_;
        to[0] = first + a;
        to[1] = first + (mirrors ? c : b);
        to[2] = first + (mirrors ? b : c);
        if (!mesh_.triangle_materials.empty()) mesh_.triangle_materials[triangles_] = primitive.material;
        ++triangles_;
      });
    }
    vertices_ += static_cast<std::size_t>(mesh.vertices);
  }

 private:
  void add_points(const GlbPrimitive& primitive, const Affine* transform) {
    double* to = mesh_.positions.data + 3 * (vertices_ + static_cast<std::size_t>(primitive.first_vertex));
    for (std::size_t i = 0; i < primitive.points.count; ++i, to += 3) {
      Vec3 p = {primitive.points.component(i, 0), primitive.points.component(i, 1), primitive.points.component(i, 2)};
      if (transform != nullptr) p = transform->apply(p);
      to[0] = p.x;
      to[1] = p.y;
      to[2] = p.z;
    }
  }

  LoadedMesh& mesh_;
  std::size_t vertices_ = 0;
  std::size_t triangles_ = 0;
};

}  // namespace

Status read_glb(Span<const unsigned char> file, LoadedMesh& mesh, Arena& arena) {
  GlbDocument document;
  ISOLOD_TRY(document.open(file, arena));
  GlbMeshes meshes;
  ISOLOD_TRY(meshes.read(document, arena));
  GlbScene scene(document.json(), meshes.meshes().count);
  ISOLOD_TRY(scene.read(arena));
  std::uint64_t vertices = 0, triangles = 0;
  for (const GlbInstance& instance : scene.instances()) {
    vertices += meshes.meshes()[instance.mesh].vertices;
    triangles += meshes.meshes()[instance.mesh].triangles;
  }
  GlbFiller filler(mesh);
  ISOLOD_TRY(filler.begin(vertices, triangles, meshes.has_materials(), arena));
  for (const GlbInstance& instance : scene.instances()) {
    filler.add(meshes.meshes()[instance.mesh], instance.transform);
  }
  return {};
}

}  // namespace v1
}  // namespace isolod
