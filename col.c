#include "law/dynamic_scene.h"
static double len(scene*s){double a=0;for(int i=0;i<s->d->n;i++)a+=bt__distance(bt__dynamic_x(s->d)[i],bt__dynamic_x(s->d)[i+1]);return a;}
static double worst(scene*s){double a=0;for(int i=0;i<s->d->n;i++)a=fmax(a,fabs(bt__dynamic_stretch(s->d)[i]-1));return a;}
static void run(const char*name,double L,int n,double ei,double seed,double span0,double span1,double rate,double w,double h,double after){
  scene s; bt_vec3 x[2001];
  double k=BT__PI/L;
  for(int i=0;i<=n;i++){double t=i/(double)n;x[i]=bt__vec(t*span0,0,seed*sin(BT__PI*t));}
  (void)k;
  bt_tether_props line={.diameter=.01,.mass=.1,.ea=2e5,.ei=ei,.cdn=1.2,.cdt=.01,.ca=1,.wet_weight=w};
  scene_open(&s,line,1025,n,x,n+1,L);
  double T=fabs(span1-span0)/rate, wl=0, ws=0;int steps=(int)((T+after)/h);
  double e0=0,gain=-1e9;
  for(int i=0;i<steps;i++){double t=(i+1)*h; double u=fmin(t/T,1); s.in.end[1].at.x=span0+(span1-span0)*u; scene_step(&s,h);
    double ll=fabs(len(&s)/L-1); wl=fmax(wl,ll); ws=fmax(ws,worst(&s));
    if(u>=1){double e=scene_energy(&s); if(e0!=0) gain=fmax(gain,e-e0); e0=e;}
  }
  double mid=bt__dynamic_x(s.d)[n/2].z;
  printf("%s n %d ei %g: len err max %.2e end %.2e str %.2e  pull %.6g %.6g  mid %.4f  unconv %ld/%d solves %.2f speed %.2e gain %.2e\n",name,n,ei,wl,len(&s)/L-1,ws,s.d->pull[0].x,s.d->pull[1].x,mid,s.unconverged,steps,s.solves/(double)steps,s.report.speed,gain);
  scene_close(&s);
}
int main(int c,char**v){ (void)c;(void)v;
 for(double ei=1e-4;ei<2e3;ei*=10) run("bow",10,40,ei,.2,9.98,9,.5,0,1./60,60);
 for(double ei=1e-4;ei<2e3;ei*=100) run("straight",10,40,ei,0,10,9,.5,0,1./60,60);
 for(double ei=1e-4;ei<2e3;ei*=100) run("back",25,50,ei,.01,24.99,17,1,0,1./60,60);
 for(double ei=1e-4;ei<2e3;ei*=100) run("heavy",25,50,ei,.01,24.99,17,1,.5,1./60,60);
 return 0;}
