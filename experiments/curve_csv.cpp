#include "experiments/curve_csv.h"

#include <fmt/format.h>

#include "experiments/version.h"
#include "mesh/atomic_file.h"

namespace gsp {

namespace {

std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace

void write_curve_csv(const std::string& path, const std::vector<CurvePoint>& points) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << "model,method,gamma,mu,base_vertices,base_faces,level,wavelet,coder,bytes,bits_per_vertex,faces,rms_forward,"
         "rms_backward,rms,hausdorff,psnr_db,samples,standard_error_db,remesh_error,seed,version,options\n";
  for (const CurvePoint& p : points)
    out << fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{:.6g},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.4f},{},{:.2g},{:.6g},{},{},{}\n",
        field(p.model), p.method, p.gamma, p.mu, p.base_vertices, p.base_faces, p.level, p.wavelet, p.coder, p.bytes,
        p.bits_per_vertex, p.faces, p.rms_forward, p.rms_backward, p.rms, p.hausdorff, p.psnr_db, p.samples,
        p.standard_error_db, p.remesh_error, p.seed, version(), p.options);
  file.commit();
}

}  // namespace gsp
