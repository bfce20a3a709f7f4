#include "geo.h"
static double rms(const std::vector<SurfaceSample>&s,const SubdivisionLevel&f,const std::vector<Vec3>&p){double a=0,b=0;for(auto q:s){double d=walk_to_nearest(f,p,q.point,q.place);a+=q.weight*d;b+=q.weight;}return std::sqrt(a/b);}
int main(int c,char**v){
  set_thread_count(1);
  int level=atoi(v[3]); Work w=load(v[1],v[2],level,1);
  printf("base %d finest %d samples %zu\n",w.map.base.vertex_count(),w.finest().vertex_count,w.samples.size());
  Ruler ruler(w.input); auto db=[&](double r){return -20*log10(r/w.diagonal);};
  ControlMap cm(w.levels); printf("S nnz/row %.1f\n",double(cm.matrix().nonZeros())/cm.matrix().rows());
  std::vector<Vec3> control(w.map.base.vertex_count());
  for(int i=0;i<w.map.base.vertex_count();++i)control[i]=w.parametric[i];
  SurfaceTree stree(w.map.surface);
  auto samples=w.samples;
  double eps=c>4?atof(v[4]):0.05;
  for(int it=0;it<6;++it){
    ControlSystem sys(cm,w.levels[0],w.finest(),level);
    auto pts=cm.points(control);
    bool first=it==0;
    if(first)for(auto&s:samples){sys.add(s.place.face,s.place.weights,s.weight*Eigen::Matrix3d::Identity(),s.weight*(s.point-s.place.at(w.finest(),pts)));}
    else { samples=samples; for(size_t i=0;i<samples.size();++i){auto&s=samples[i]; walk_to_nearest(w.finest(),pts,s.point,s.place);
      Vec3 gap=s.point-s.place.at(w.finest(),pts); Vec3 n=s.place.inside_face()?doubled_area(w.finest().faces[s.place.face],pts):gap; auto u=unit(n); if(!u)continue;
      sys.add(s.place.face,s.place.weights,s.weight*((*u)*u->transpose()),s.weight*gap.dot(*u)*(*u));
      if(eps>0){auto&q=w.samples[i]; Vec3 g=q.point-q.place.at(w.finest(),pts); sys.add(q.place.face,q.place.weights,s.weight*eps*Eigen::Matrix3d::Identity(),s.weight*eps*g);} } }
    sys.add_tether(1e-9);
    auto m=sys.solve(); for(size_t i=0;i<m.size();++i)control[i]+=m[i];
    pts=cm.points(control);
    printf("it %d: sample dist %.2f dB  ruler %.2f\n",it,db(rms(samples,w.finest(),pts)),ruler(as_mesh(w,pts).mesh()));fflush(stdout);
  }
  for(int bits:{0,10,9,8,7}){
    std::vector<Vec3> q=control; if(bits){double step=w.diagonal/(1<<bits);for(auto&p:q)for(int k=0;k<3;++k)p[k]=step*std::round(p[k]/step);}
    SmoothSurface s=smooth_surface(w.levels,q);
    auto st=pierce(w,s,stree,3.0); auto&start=st.s; double var=0; printf("hits %d far %d miss %d\n",st.hits,st.far,st.miss);
    auto sm=w.samples; 
    std::vector<double> zero=start;
    auto sc=fit_scalars(w.finest(),s,sm,{},zero);
    for(double x:sc)var+=x*x; auto p=displaced_points(s,sc);
    printf("bits %d: scalar rms %.2f dB; start %.2f fitted %.2f ruler %.2f\n",bits,db(sqrt(var/sc.size())),db(rms(w.samples,w.finest(),displaced_points(s,start))),db(rms(sm,w.finest(),p)),ruler(as_mesh(w,p).mesh(),100000));fflush(stdout);
    if(bits==0){write_mesh("/tmp/lab/smooth.ply",as_mesh(w,s.points).mesh(),{});write_mesh("/tmp/lab/disp.ply",as_mesh(w,p).mesh(),{});}
    if(getenv("ONE"))break;
  }
}
