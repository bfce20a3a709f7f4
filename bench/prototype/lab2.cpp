#include "geo.h"
#include "coder/displaced/scalar_planes.h"
#include "coder/wavelet_transform.h"
#include <map>
#include <Eigen/Dense>
static double env(const char*n,double d){const char*s=getenv(n);return s?atof(s):d;}
int main(int c,char**v){
  set_thread_count(1);
  int level=atoi(v[3]); Work w=load(v[1],v[2],level,1);
  int bits=env("BITS",8); double eps=env("EPS",0.01);
  int b=w.map.base.vertex_count();
  Ruler ruler(w.input); 
  ControlMap cm(w.levels);
  std::vector<Vec3> control(b), ls;
  int gn=env("GN",3), patches=w.levels[0].face_count();
  std::vector<double> peps(patches,eps);
  auto samples=w.samples; SmoothSurface s; std::vector<SurfaceSample> sm; std::vector<double> sc; std::vector<Vec3> disp; ScalarFitOptions fo; fo.stiffness=env("STIFF",5e-3); double smooth_db=0; int held=0;
  SampledSurface back; std::vector<int> first_face(w.finest().vertex_count); for(int f=0;f<w.finest().face_count();++f)for(int x:w.finest().faces[f])first_face[x]=f;
  for(int round=0;round<=env("ROUNDS",3);++round){
    for(int i=0;i<b;++i)control[i]=w.parametric[i];
    if(round>0)control=ls;
    samples=w.samples; back=back_of(w,env("BACK",1));
    for(int it=round>0;it<=gn;++it){
      ControlSystem sys(cm,w.levels[0],w.finest(),level);
      auto pts=cm.points(control);
      if(it==0)for(auto&s:samples)sys.add(s.place.face,s.place.weights,s.weight*Eigen::Matrix3d::Identity(),s.weight*(s.point-s.place.at(w.finest(),pts)));
      else for(size_t i=0;i<samples.size();++i){auto&s=samples[i]; walk_to_nearest(w.finest(),pts,s.point,s.place);
        Vec3 gap=s.point-s.place.at(w.finest(),pts); Vec3 n=s.place.inside_face()?doubled_area(w.finest().faces[s.place.face],pts):gap; auto u=unit(n); if(!u)continue;
        sys.add(s.place.face,s.place.weights,s.weight*((*u)*u->transpose()),s.weight*gap.dot(*u)*(*u));
        auto&q=w.samples[i]; double e=peps[q.place.face>>(2*level)]; Vec3 g=q.point-q.place.at(w.finest(),pts); sys.add(q.place.face,q.place.weights,s.weight*e*Eigen::Matrix3d::Identity(),s.weight*e*g); }
      if(it>0&&env("BACK",1)>0){ double bw=env("BACK",1); for(size_t x=0;x<pts.size();++x){ walk_to_nearest(w.dense_level,w.dense,pts[x],back.places[x]); auto&pl=back.places[x]; Vec3 gap=pl.at(w.dense_level,w.dense)-pts[x]; auto u=unit(pl.inside_face()?doubled_area(w.dense_level.faces[pl.face],w.dense):gap); if(!u)continue; 
         int f=first_face[x]; std::array<double,3> ww{0,0,0}; for(int k=0;k<3;++k)if(w.finest().faces[f][k]==(int)x)ww[k]=1; sys.add(f,ww,bw*((*u)*u->transpose()),bw*gap.dot(*u)*(*u)); } }
      sys.add_tether(1e-9);
      auto m=sys.solve(); for(size_t i=0;i<m.size();++i)control[i]+=m[i];
      if(it==0)ls=control;
    }
    double step=w.diagonal/(1<<bits);
    if(double ratio=env("RATIO",0)){
      auto nrm=smooth_surface({w.levels[0]},control).normals; double ts=ratio*step;
      std::vector<Eigen::Matrix3d> fr; for(auto&n:nrm){Vec3 a=n.unitOrthogonal();Eigen::Matrix3d m;m<<a,n.cross(a),n;fr.push_back(m);}
      for(int i=0;i<b;++i){Vec3 q=fr[i].transpose()*control[i]; for(int k=0;k<2;++k)q[k]=ts*std::round(q[k]/ts); control[i]=fr[i]*q;}
      for(int it=0;it<2;++it){ auto pts=cm.points(control); Eigen::MatrixXd H=Eigen::MatrixXd::Zero(b,b); Eigen::VectorXd R=Eigen::VectorXd::Zero(b);
        auto add=[&](int face,const std::array<double,3>&ww,const Vec3&u,double gap,double wt){ std::vector<std::pair<int,double>> row; for(int k=0;k<3;++k)if(ww[k])for(SparseMatrix::InnerIterator j(cm.matrix(),w.finest().faces[face][k]);j;++j){bool f=false;for(auto&r:row)if(r.first==j.col()){r.second+=ww[k]*j.value();f=true;}if(!f)row.push_back({(int)j.col(),ww[k]*j.value()});} for(auto&r:row)r.second*=u.dot(nrm[r.first]); for(auto&r:row){R[r.first]+=wt*r.second*gap;for(auto&q:row)H(r.first,q.first)+=wt*r.second*q.second;} };
        for(size_t i=0;i<samples.size();++i){auto&s=samples[i]; walk_to_nearest(w.finest(),pts,s.point,s.place); Vec3 gap=s.point-s.place.at(w.finest(),pts); auto u=unit(s.place.inside_face()?doubled_area(w.finest().faces[s.place.face],pts):gap); if(u)add(s.place.face,s.place.weights,*u,gap.dot(*u),s.weight);}
        for(size_t x=0;x<pts.size();++x){ walk_to_nearest(w.dense_level,w.dense,pts[x],back.places[x]); auto&pl=back.places[x]; Vec3 gap=pl.at(w.dense_level,w.dense)-pts[x]; auto u=unit(pl.inside_face()?doubled_area(w.dense_level.faces[pl.face],w.dense):gap); if(!u)continue; int f=first_face[x]; std::array<double,3> ww{0,0,0}; for(int k=0;k<3;++k)if(w.finest().faces[f][k]==(int)x)ww[k]=1; add(f,ww,*u,gap.dot(*u),1.0);}
        double mean=H.trace()/b; H.diagonal().array()+=0.02*mean; Eigen::VectorXd m=H.llt().solve(R); for(int i=0;i<b;++i)control[i]+=m[i]*nrm[i]; }
      for(int i=0;i<b;++i){Vec3 q=fr[i].transpose()*control[i]; q[2]=step*std::round(q[2]/step); control[i]=fr[i]*q;}
    } else for(auto&p:control)for(int k=0;k<3;++k)p[k]=step*std::round(p[k]/step);
    s=smooth_surface(w.levels,control);
    smooth_db=ruler(as_mesh(w,s.points).mesh());
    sm=samples; for(auto&q:sm)walk_to_nearest(w.finest(),s.points,q.point,q.place);
    ScalarFitOptions f1; f1.stiffness=env("STIFF1",1e-2); f1.damping=env("DAMP",0.02); f1.reach=1.0; f1.most_rounds=4; f1.tangential=env("TAN",0.5);
    disp=fit_displacements(w.finest(),s,sm,f1,std::vector<Vec3>(s.points.size(),Vec3::Zero()),back); fo.tangential=env("TAN",0.5);fo.damping=0.01;
    disp=fit_displacements(w.finest(),s,sm,fo,disp,back);
    auto p=s.points; sc.resize(p.size()); double tt=0,nn=0; std::vector<double> tl; for(size_t i=0;i<p.size();++i){p[i]+=disp[i]; sc[i]=s.normals[i].dot(disp[i]); double t=(disp[i]-sc[i]*s.normals[i]).norm(); tl.push_back(t/w.diagonal); tt+=t*t;nn+=sc[i]*sc[i];} std::sort(tl.begin(),tl.end()); fprintf(stderr,"tangential share %.4f; quantiles .5 %.6f .9 %.6f .99 %.6f 1 %.6f\n",sqrt(tt/nn),tl[tl.size()/2],tl[tl.size()*.9],tl[tl.size()*.99],tl.back());
    std::vector<double> err(patches,0),wt(patches,0); for(size_t i=0;i<sm.size();++i){double d=walk_to_nearest(w.finest(),p,sm[i].point,sm[i].place);int f=w.samples[i].place.face>>(2*level);err[f]+=sm[i].weight*d;wt[f]+=sm[i].weight;}
    double tot=0; for(int f=0;f<patches;++f){err[f]/=wt[f];tot+=err[f]/patches;}
    auto sorted=err; std::sort(sorted.begin(),sorted.end()); double med=sorted[patches/2];
    std::vector<char> bad(w.levels[0].vertex_count,0); int nb=0;
    for(int f=0;f<patches;++f)if(err[f]>env("BAD",50)*med){++nb;for(int x:w.levels[0].faces[f])bad[x]=1;}
    fprintf(stderr,"round %d smooth %.2f err %.2f dB median %.2f bad %d\n",round,smooth_db,-10*log10(tot)+20*log10(w.diagonal),-10*log10(med)+20*log10(w.diagonal),nb);
    if(nb==0)break; held=0;
    for(int f=0;f<patches;++f){bool x=false;for(int q:w.levels[0].faces[f])x|=bad[q];if(x)peps[f]=std::min(3.0,peps[f]*env("UP",10));}
  }
  struct{int hits=0;}st;
  auto full=s.points; for(size_t i=0;i<full.size();++i)full[i]+=disp[i];
  double ceiling=ruler(as_mesh(w,displaced_points(s,sc)).mesh(),100000); printf("vector ceiling %.2f\n",ruler(as_mesh(w,full).mesh(),100000));
  { auto p=full; SurfaceTree st2(w.input); std::vector<double> wt(p.size(),0); for(auto&q:sm)for(int k=0;k<3;++k)wt[w.finest().faces[q.place.face][k]]+=q.weight*q.place.weights[k]; std::vector<double> par(p.size(),0);for(auto&q:w.samples)for(int k=0;k<3;++k)par[w.finest().faces[q.place.face][k]]+=q.weight*q.place.weights[k];
    std::vector<std::pair<double,int>> ds; double tot=0; for(size_t i=0;i<p.size();++i){int h=-1;double d=st2.squared_distance(p[i],h);ds.push_back({d,(int)i});tot+=d;} std::sort(ds.rbegin(),ds.rend()); double acc=0; for(int i=0;i<400;++i){acc+=ds[i].first; if(i%40==0){int x=ds[i].second; Vec3 n=Vec3::Zero(); for(auto&t:w.finest().faces)for(int k:t)if(k==x){n+=doubled_area(t,s.points);} Vec3 m=Vec3::Zero(); for(auto&t:w.finest().faces)for(int k:t)if(k==x){m+=doubled_area(t,p);} printf("#%d v %d dist %.1f dB share %.2f s %.5f weight %.2f (%.2f) nn %.2f %.2f\n",i,x,-10*log10(ds[i].first)+20*log10(w.diagonal),acc/tot,sc[x]/w.diagonal,wt[x],par[x],n.normalized().dot(s.normals[x]),m.normalized().dot(s.normals[x]));} } }
  // transform
  std::vector<SubdivisionLevel> dl(w.levels.begin(),w.levels.end()-1);
  WaveletTransform tr(dl,Wavelet::ButterflyLifted);
  std::vector<double> area(w.finest().vertex_count,0); for(auto&t:w.finest().faces){double a=doubled_area(t,s.points).norm()/6;for(int x:t)area[x]+=a;}
  std::vector<double> weight(area.size());
  for(int l=level-1;l>=0;--l){auto&L=w.levels[l]; int V=L.vertex_count; for(int e=0;e<L.edge_count();++e)weight[V+e]=std::sqrt(area[V+e]); for(int e=0;e<L.edge_count();++e)for(int k=0;k<2;++k)area[L.edges[e][k]]+=area[V+e]/2;}
  for(int x=0;x<b;++x)weight[x]=std::sqrt(area[x])*0.792/0.685;
  std::vector<Vec3> f(sc.size()); for(size_t i=0;i<f.size();++i)f[i]=Vec3(sc[i],0,0);
  std::vector<double> coef(sc.size());
  for(int l=level-1;l>=0;--l){auto sp=tr.analysis(l,f); for(size_t e=0;e<sp.details.size();++e)coef[w.levels[l].vertex_count+e]=sp.details[e][0]; f=sp.coarse;}
  for(int x=0;x<b;++x)coef[x]=f[x][0];
  double biggest=0; for(size_t i=0;i<coef.size();++i)biggest=std::max(biggest,std::abs(coef[i])*weight[i]);
  int planes=20; double delta=biggest*1.0000001/(1<<planes);
  ScalarForest forest(dl); ScalarIntegers ints;
  for(size_t i=0;i<coef.size();++i){ints.magnitude.push_back(std::abs(coef[i])*weight[i]/delta);ints.negative.push_back(coef[i]<0);}
  ScalarLayout lay; lay.planes=planes; lay.last_plane=env("LAST",7);
  Bytes out; std::vector<size_t> ends; auto parts=encode_scalars(forest,lay,ints,out,&ends);
  double base=b*(3*(bits-2.57)+2.3)/8+20;
  printf("%s base %d (%.0f B at %d bits) n %zu hits %d/%d smooth %.2f ceiling %.2f\n",v[1],b,base,bits,sc.size(),st.hits,(int)sc.size(),smooth_db,ceiling);
  auto&d=parts.details[0]; printf("bytes: trees %.0f sig %.0f signs %.0f ref %.0f total %zu\n",d.trees/8,d.significance/8,d.signs/8,d.refinement/8,out.size());
  if(env("QUIET",0))return 0;
  double f1=env("C1",0.47),f2=env("C2",0.55);
  for(size_t i=0;i<ends.size();i+=3){ if(ends[i]+base>40000)break; if(ends[i]<30)continue;
    auto k=decode_scalars(forest,lay,out.data(),out.data()+ends[i]);
    std::vector<double> q(coef.size());
    for(size_t n=0;n<q.size();++n)if(k.magnitude[n]){double sh=k.magnitude[n]>>k.low_plane[n]==1?f1:f2; q[n]=(k.magnitude[n]+sh*(1u<<k.low_plane[n]))*delta/weight[n]*(k.negative[n]?-1:1);}
    std::vector<Vec3> x(b); for(int j=0;j<b;++j)x[j]=Vec3(q[j],0,0);
    for(int l=0;l<level;++l){std::vector<Vec3> det(w.levels[l].edge_count());for(size_t e=0;e<det.size();++e)det[e]=Vec3(q[w.levels[l].vertex_count+e],0,0); x=tr.synthesis(l,x,det);}
    std::vector<double> y(x.size()); for(size_t n=0;n<y.size();++n)y[n]=x[n][0];
    printf("%6.0f %6.2f\n",base+ends[i],ruler(as_mesh(w,displaced_points(s,y)).mesh(),30000));fflush(stdout);
  }
}
