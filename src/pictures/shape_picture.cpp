#include "src/pictures/shape_picture.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "src/base/index.hpp"
#include "src/pictures/picture_rays.hpp"

namespace coseg {

namespace {

using Eigen::Vector3f;
constexpr int packet = PictureRays::packet;
using Directions = std::array<Vector3f, packet>;

constexpr float eye_distance = 8.0F;
constexpr double crease_degrees = 40.0;
constexpr int samples = 4;  // a pixel
// A rotated grid: no two samples in one row or column, so near-horizontal and near-vertical edges get all
// four steps.
constexpr std::array<std::array<float, 2>, samples> sample_places = {
    {{0.375F, 0.125F}, {0.875F, 0.375F}, {0.125F, 0.625F}, {0.625F, 0.875F}}};
constexpr int pattern = 4;  // pixels after which the directions of light rays repeat; smoothing spans as many

constexpr float surface_offset = 2e-4F;
constexpr float sky_reach = 0.9F;
constexpr float lamp_spread = 0.16F;

/// The eye and the rectangle of directions that the picture shows.
struct Camera {
    Vector3f eye, right, up, towards;
    float middle_x, middle_y;  // tangents of the rectangle's middle
    float step;                // tangent a pixel

    [[nodiscard]] Vector3f direction(float x, float y, int size) const {
        const float half = 0.5F * static_cast<float>(size);
        return (-towards + (middle_x + (x - half) * step) * right + (middle_y - (y - half) * step) * up)
            .normalized();
    }
};

Camera fit_camera(const TriMesh& mesh, const View& view, const PictureOptions& options) {
    Camera camera;
    camera.right = view.right().cast<float>();
    camera.up = view.up.cast<float>();
    camera.towards = view.towards.cast<float>();
    camera.eye = eye_distance * camera.towards;
    Eigen::Array2f low = Eigen::Array2f::Constant(1e9F);
    Eigen::Array2f high = -low;
    for (const int v : mesh.faces.reshaped()) {
        const Vector3f point = mesh.vertices.col(v).cast<float>();
        const Eigen::Array2f place = Eigen::Array2f(point.dot(camera.right), point.dot(camera.up)) /
                                     (eye_distance - point.dot(camera.towards));
        low = low.min(place);
        high = high.max(place);
    }
    camera.middle_x = 0.5F * (low.x() + high.x());
    camera.middle_y = 0.5F * (low.y() + high.y());
    const float extent = std::max((high - low).maxCoeff(), 1e-6F);
    const auto size = static_cast<float>(options.size);
    camera.step = extent / (size * static_cast<float>(1.0 - 2.0 * options.margin));
    return camera;
}

/// What the eye meets in a pixel, as the mean of its samples. The light is not yet weakened by what blocks
/// it.
struct Pixel {
    Vector3f sky = Vector3f::Zero();
    Vector3f lamp = Vector3f::Zero();
    float covered = 0.0F;
    Vector3f place = Vector3f::Zero();   // of the first sample that meets the shape
    Vector3f normal = Vector3f::Zero();  // of its triangle, towards the eye; 0: none
    float open_sky = 1.0F;
    float open_lamp = 1.0F;
};

class Painter {
  public:
    Painter(const PictureMesh& picture, const View& view, const PictureOptions& options)
        : picture_(picture),
          size_(options.size),
          camera_(fit_camera(picture.mesh, view, options)),
          lamp_((-0.55F * camera_.right + 0.75F * camera_.up + 0.8F * camera_.towards).normalized()),
          rays_(picture.mesh),
          normals_(corner_normals(picture.mesh, crease_degrees)),
          pixels_(at(size_) * at(size_)) {
        for (int i = 0; i < 256; ++i) light_of_byte_[at(i)] = static_cast<float>(linear_of_srgb(i / 255.0));
    }

    Image paint(const Color& background) {
        look();
        light();
        smooth_light();
        return develop(background);
    }

  private:
    [[nodiscard]] Pixel& pixel(int x, int y) { return pixels_[at(y * size_ + x)]; }

    void look();
    void shade(Pixel& pixel, const PictureRays::Hit& hit, const Vector3f& direction) const;
    void light();
    void smooth_light();
    [[nodiscard]] Image develop(const Color& background);

    const PictureMesh& picture_;
    int size_;
    Camera camera_;
    Vector3f lamp_;  // direction to it
    PictureRays rays_;
    Eigen::Matrix3Xf normals_;
    std::vector<Pixel> pixels_;
    std::array<float, 256> light_of_byte_{};
};

void Painter::look() {
    constexpr int pixels_a_packet = packet / samples;
    const int count = size_ * size_;
    for (int first = 0; first < count; first += pixels_a_packet) {
        Directions directions;
        for (int i = 0; i < packet; ++i) {
            const int number = std::min(first + i / samples, count - 1);
            const auto& place = sample_places[at(i % samples)];
            const int row = number / size_;
            directions[at(i)] = camera_.direction(static_cast<float>(number % size_) + place[0],
                                                  static_cast<float>(row) + place[1], size_);
        }
        const auto hits = rays_.look(camera_.eye, directions);
        for (int i = 0; i < packet; ++i) {
            const auto k = at(i);
            const int number = first + i / samples;
            if (number < count && hits[k].triangle >= 0) shade(pixels_[at(number)], hits[k], directions[k]);
        }
    }
}

Vector3f flipped_towards(const Vector3f& normal, const Vector3f& direction) {
    return normal.dot(direction) > 0.0F ? Vector3f(-normal) : normal;
}

void Painter::shade(Pixel& pixel, const PictureRays::Hit& hit, const Vector3f& direction) const {
    const Eigen::Index corner = 3 * static_cast<Eigen::Index>(hit.triangle);
    const Vector3f blended = (1.0F - hit.u - hit.v) * normals_.col(corner) +
                             hit.u * normals_.col(corner + 1) + hit.v * normals_.col(corner + 2);
    const auto face = picture_.mesh.faces.col(hit.triangle);
    const Vector3f a = picture_.mesh.vertices.col(face[0]).cast<float>();
    const Vector3f b = picture_.mesh.vertices.col(face[1]).cast<float>();
    const Vector3f c = picture_.mesh.vertices.col(face[2]).cast<float>();
    const Vector3f flat = flipped_towards((b - a).cross(c - a).normalized(), direction);
    // A smooth normal may lean away from the eye where its triangle does not; then the light's edge would
    // show.
    Vector3f normal = blended.squaredNorm() > 1e-12F ? Vector3f(blended.normalized()) : flat;
    if (normal.dot(flat) < 0.0F) normal = -normal;

    Vector3f albedo;
    const Color& color = picture_.colors[at(hit.triangle)];
    for (int k = 0; k < 3; ++k) albedo[k] = light_of_byte_[color[at(k)]];
    const float share = 1.0F / samples;
    const float above = 0.5F + 0.5F * normal.dot(camera_.up);
    const float facing = std::max(0.0F, normal.dot(camera_.towards));
    pixel.sky += share * (0.27F + 0.20F * above + 0.13F * facing) * albedo;
    const float lit = std::max(0.0F, (normal.dot(lamp_) + 0.15F) / 1.15F);
    const Vector3f half = (lamp_ - direction).normalized();
    const float gloss = std::pow(std::max(0.0F, normal.dot(half)), 48.0F);
    pixel.lamp += share * (0.50F * lit * albedo + 0.05F * gloss * Vector3f::Ones());
    pixel.covered += share;
    if (!pixel.normal.isZero()) return;
    pixel.normal = flat;
    pixel.place = camera_.eye + hit.distance * direction + surface_offset * flat;
}

/// The van der Corput sequence in base 2, and a shift that differs from pixel to pixel of the pattern.
float radical_inverse(unsigned i) {
    unsigned bits = i;
    bits = (bits << 16U) | (bits >> 16U);
    bits = ((bits & 0x00FF00FFU) << 8U) | ((bits & 0xFF00FF00U) >> 8U);
    bits = ((bits & 0x0F0F0F0FU) << 4U) | ((bits & 0xF0F0F0F0U) >> 4U);
    bits = ((bits & 0x33333333U) << 2U) | ((bits & 0xCCCCCCCCU) >> 2U);
    bits = ((bits & 0x55555555U) << 1U) | ((bits & 0xAAAAAAAAU) >> 1U);
    return static_cast<float>(bits) * 0x1p-32F;
}

/// Local directions for the pattern's cells: about z, denser towards it as the cosine.
using Pattern = std::array<Directions, static_cast<std::size_t>(pattern) * pattern>;

Pattern sky_pattern() {
    Pattern cells;
    constexpr int total = packet * pattern * pattern;
    for (int cell = 0; cell < pattern * pattern; ++cell) {
        for (int i = 0; i < packet; ++i) {
            // Interleaved, so that each cell covers the sky evenly and all cells together cover it finely.
            const int number = i * pattern * pattern + cell;
            const float height = (static_cast<float>(number) + 0.5F) / total;
            const float turn =
                2.0F * std::numbers::pi_v<float> * radical_inverse(static_cast<unsigned>(number * 7 + cell));
            const float radius = std::sqrt(height);
            cells[at(cell)][at(i)] = {radius * std::cos(turn), radius * std::sin(turn),
                                      std::sqrt(1.0F - height)};
        }
    }
    return cells;
}

void Painter::light() {
    static const Pattern cells = sky_pattern();
    const Eigen::Matrix3f to_lamp =
        Eigen::Quaternionf::FromTwoVectors(Vector3f::UnitZ(), lamp_).toRotationMatrix();
    for (int y = 0; y < size_; ++y) {
        for (int x = 0; x < size_; ++x) {
            Pixel& here = pixel(x, y);
            if (here.normal.isZero()) continue;
            const Directions& cell = cells[at((y % pattern) * pattern + x % pattern)];
            const Eigen::Matrix3f to_normal =
                Eigen::Quaternionf::FromTwoVectors(Vector3f::UnitZ(), here.normal).toRotationMatrix();
            Directions sky;
            Directions lamp;
            for (std::size_t i = 0; i < packet; ++i) {
                sky[i] = to_normal * cell[i];
                lamp[i] = to_lamp * Vector3f(lamp_spread * cell[i].x(), lamp_spread * cell[i].y(), 1.0F);
            }
            here.open_sky = 1.0F - static_cast<float>(rays_.blocked(here.place, sky, sky_reach)) / packet;
            const bool faces_lamp = here.normal.dot(lamp_) > -0.1F;
            here.open_lamp =
                faces_lamp ? 1.0F - static_cast<float>(rays_.blocked(here.place, lamp, 4.0F)) / packet : 0.0F;
        }
    }
}

/// Over a whole pattern around the pixel, but not across an edge of the surface.
void Painter::smooth_light() {
    std::vector<std::array<float, 2>> smooth(pixels_.size(), {1.0F, 1.0F});
    const float reach = 3.0F * camera_.step * eye_distance * pattern;
    for (int y = 0; y < size_; ++y) {
        for (int x = 0; x < size_; ++x) {
            const Pixel& here = pixel(x, y);
            if (here.normal.isZero()) continue;
            std::array<float, 3> sum{};
            for (int v = std::max(0, y - 2); v <= std::min(size_ - 1, y + 2); ++v) {
                for (int u = std::max(0, x - 2); u <= std::min(size_ - 1, x + 2); ++u) {
                    const Pixel& other = pixel(u, v);
                    if (other.normal.isZero() || other.normal.dot(here.normal) < 0.8F) continue;
                    if (std::abs((other.place - here.place).dot(here.normal)) > 0.25F * reach) continue;
                    // The outer ring counts half to either side: 4 x 4 pixels in all, each cell of the
                    // pattern once.
                    const float weight =
                        (std::abs(u - x) == 2 ? 0.5F : 1.0F) * (std::abs(v - y) == 2 ? 0.5F : 1.0F);
                    sum[0] += weight * other.open_sky;
                    sum[1] += weight * other.open_lamp;
                    sum[2] += weight;
                }
            }
            smooth[at(y * size_ + x)] = {sum[0] / sum[2], sum[1] / sum[2]};
        }
    }
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        pixels_[i].open_sky = smooth[i][0];
        pixels_[i].open_lamp = smooth[i][1];
    }
}

/// Where the sky does not reach, light that bounced off the shape itself does.
float softened(float open_sky) { return 0.22F + 0.78F * open_sky; }

Image Painter::develop(const Color& background) {
    Image image(size_, size_, background);
    for (int y = 0; y < size_; ++y) {
        for (int x = 0; x < size_; ++x) {
            const Pixel& here = pixel(x, y);
            if (here.covered <= 0.0F) continue;
            for (int k = 0; k < 3; ++k) {
                const auto c = at(k);
                const float light = here.sky[k] * softened(here.open_sky) + here.lamp[k] * here.open_lamp +
                                    (1.0F - here.covered) * light_of_byte_[background[c]];
                const double value = srgb_of_linear(std::clamp(static_cast<double>(light), 0.0, 1.0));
                image.pixel(x, y)[c] = static_cast<std::uint8_t>(std::lround(255.0 * value));
            }
        }
    }
    return image;
}

}  // namespace

Image shape_picture(const PictureMesh& mesh, const View& view, const PictureOptions& options) {
    if (mesh.mesh.face_count() == 0) return {options.size, options.size, options.background};
    return Painter(mesh, view, options).paint(options.background);
}

}  // namespace coseg
