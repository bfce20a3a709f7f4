#pragma once
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include "mesh/io.h"
#include "mesh/parallel.h"
#include "metrics/surface_distance.h"
#include "param/map/param_file.h"
#include "remesh/remesh.h"
#include "remesh/displaced/control_fit.h"
#include "remesh/displaced/scalar_fit.h"
#include "remesh/filters/smooth_surface.h"
#include "mesh/fixed_order.h"
using namespace gsp;
inline Progress silent_;
struct Work {
  Parameterization map;
  Mesh input;
  int level;
  std::vector<SubdivisionLevel> levels;
  std::vector<SurfaceSample> samples;
  std::vector<Vec3> parametric, dense; SubdivisionLevel dense_level;
  double diagonal;
  const SubdivisionLevel& finest() const { return levels.back(); }
};
inline std::array<std::array<double,3>,3> sub(const std::array<std::array<double,3>,3>& c,int i){
  auto mid=[&](int a,int b){std::array<double,3> m;for(int k=0;k<3;++k)m[k]=(c[a][k]+c[b][k])/2;return m;};
  auto ab=mid(0,1),bc=mid(1,2),ca=mid(2,0);
  switch(i){case 0:return {c[0],ab,ca};case 1:return {ab,c[1],bc};case 2:return {ca,bc,c[2]};default:return {ab,bc,ca};}
}
inline Work load(const std::string& mapfile,const std::string& model,int level,int extra){
  Work w; w.map=read_parameterization(mapfile); w.input=read_mesh(model); w.level=level;
  w.diagonal=bounding_box_diagonal(w.input);
  RemeshOptions o; o.level=level+extra; o.positions=Positions::Sampled;
  SemiregularMesh fine=remesh(w.map,o,silent_);
  auto all=subdivision_levels(fine.base_vertices,fine.base_faces,level+extra);
  w.levels.assign(all.begin(),all.begin()+level+1);
  w.parametric.assign(fine.positions.begin(),fine.positions.begin()+w.levels.back().vertex_count);
  w.dense=fine.positions; w.dense_level=all.back();
  const auto& f=all.back();
  std::vector<char> done(f.vertex_count,0);
  std::vector<int> around(f.vertex_count,0);
  for(auto&t:f.faces)for(int v:t)++around[v];
  for(int i=0;i<f.face_count();++i){
    std::array<std::array<double,3>,3> c={{{1,0,0},{0,1,0},{0,0,1}}};
    for(int l=extra-1;l>=0;--l)c=sub(c,(i>>(2*l))&3);
    for(int k=0;k<3;++k){int v=f.faces[i][k]; if(done[v])continue;done[v]=1;
      SurfaceSample s; s.point=fine.positions[v]; s.weight=around[v]/(3.0*(1<<(2*extra))); s.place={i>>(2*extra),c[k]}; w.samples.push_back(s);}
  }
  return w;
}
inline SampledSurface back_of(const Work&w,double weight){ SampledSurface b{&w.dense_level,&w.dense,{},weight}; b.places.resize(w.finest().vertex_count); for(int f=0;f<w.dense_level.face_count();++f)for(int k=0;k<3;++k){int v=w.dense_level.faces[f][k]; if(v<(int)b.places.size()){b.places[v].face=f;b.places[v].weights={0,0,0};b.places[v].weights[k]=1;}} return b; }
inline SemiregularMesh as_mesh(const Work&w,const std::vector<Vec3>&p){return {w.level,w.map.base.vertex_count(),w.map.base.faces,p};}
struct Ruler{ const Mesh& in; SurfaceTree tree; Ruler(const Mesh&m):in(m),tree(m){}
  double operator()(const Mesh& d,std::size_t n=60000){DistanceOptions o;o.samples=n;auto r=surface_distance(in,tree,d,o,silent_);return r.psnr_db();}};
#include "remesh/displaced/piercing.h"
struct Starts{ std::vector<double> s; std::vector<char> hit; int hits=0,far=0,miss=0; };
// hits where found within aperture*local edge; the rest: harmonic fill
inline Starts pierce(const Work&w,const SmoothSurface&s,const SurfaceTree&tree,double aperture){
  Starts r; size_t n=s.points.size(); r.s.assign(n,0); r.hit.assign(n,0);
  static Piercing walk(w.map.surface);
  const auto& f=w.finest(); std::vector<double> spacing(n,0);
  for(auto&[a,b]:f.edges){double l=(w.parametric[a]-w.parametric[b]).norm();spacing[a]=std::max(spacing[a],l);spacing[b]=std::max(spacing[b],l);}
  for(size_t v=0;v<n;++v){int hint=-1; tree.squared_distance(w.parametric[v],hint); auto h=walk.walk(hint,s.points[v],s.normals[v]);
    if(!h){++r.miss;continue;} Vec3 p=s.points[v]+h->along*s.normals[v]; if((p-w.parametric[v]).norm()>aperture*spacing[v]){++r.far;continue;}
    r.s[v]=h->along;r.hit[v]=1;++r.hits;}
  // upright: faces turning against the parametric face
  for(int pass=0;pass<3;++pass){ auto p=displaced_points(s,r.s); for(auto&t:f.faces){Vec3 a=doubled_area(t,p),b=doubled_area(t,w.parametric); if(r.hit[t[0]]&&r.hit[t[1]]&&r.hit[t[2]]&&a.dot(b)<=0.1*a.norm()*b.norm())for(int x:t)if(r.hit[x]){r.hit[x]=0;--r.hits;++r.far;}}
  // fill
  std::vector<double> x=r.s; for(size_t v=0;v<n;++v)if(!r.hit[v])x[v]=dot(s.normals[v],w.parametric[v]-s.points[v]);
  for(int it=0;it<60;++it){ std::vector<double> sum(n,0),cnt(n,0); for(auto&[a,b]:f.edges){sum[a]+=x[b];cnt[a]++;sum[b]+=x[a];cnt[b]++;} for(size_t v=0;v<n;++v)if(!r.hit[v])x[v]=sum[v]/cnt[v]; }
  r.s=x; }
  return r;
}
