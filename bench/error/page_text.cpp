// SPDX-License-Identifier: Apache-2.0
#include "error/page_text.h"

namespace umbrix::bench {

const char* const kPageStyle = R"(
body { margin: 0 auto; max-width: 1040px; padding: 1.5rem; background: #fff; color: #1a1a1a;
  font: 16px/1.5 "Helvetica Neue", Helvetica, Arial, sans-serif; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 .3rem; }
h2 { font-size: 1.4rem; margin: 2.5rem 0 .5rem; border-bottom: 1px solid #ccc; padding-bottom: .2rem; }
h3 { font-size: 1.1rem; margin: 1.5rem 0 .3rem; }
p, li { max-width: 46rem; }
.lead { font-size: 1.1rem; }
nav a { margin-right: 1rem; white-space: nowrap; }
a { color: #005a9c; }
figure { margin: 1rem 0; }
figure svg { width: 100%; height: auto; display: block; border: 1px solid #ddd; }
figcaption { color: #555; font-size: .9rem; margin-top: .2rem; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(400px, 1fr)); gap: 1rem; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .82rem; margin: .8rem 0; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: bold; padding-bottom: .3rem; }
th, td { padding: .15rem .5rem; text-align: right; border-bottom: 1px solid #eee; vertical-align: baseline; }
thead th { border-bottom: 2px solid #999; vertical-align: bottom; }
th[scope=row] { text-align: left; font-weight: normal; white-space: nowrap; }
td.text { text-align: left; white-space: nowrap; }
td b { font-weight: inherit; }
td span, td i { color: #666; font-style: normal; font-size: .92em; white-space: nowrap; }
summary { cursor: pointer; color: #005a9c; }
)";

const char* const kMethods = R"(
<p><b>Truth.</b> A ray is occluded if some t with tmin &lt; t &lt; tmax lies on a triangle, for the given float ray and
float vertices, in real arithmetic; edges and vertices belong to the triangle, and a ray within its plane does not hit
it. Every ray of every set is judged: tests in double with error bounds, and exact integers for what they leave open.
The judge shares no code with the tracer. A <i>leak</i> is an occluded ray that a tracer lets through; a <i>false
shadow</i> is an unoccluded one that it stops. Rates are a million of all rays of the set; intervals are those of Clopper
and Pearson (95 %, two-sided), as if rays were independent. Rays of one picture are not quite: neighbours meet the same
triangles.</p>
<p><b>Ordinary rays</b> are those of a frame: one from each primary hit that faces the light to each light of the setup,
moved off the surface by 1e-5 of the scene's diagonal, with a direction of unit length. <i>Flux error</i> is the
irradiance that wrong answers add or take, over all irradiance.</p>
<p><b>Adversarial rays</b> are aimed at random triangles of the same scene from random directions, 0.5 to 5.5 % of the
diagonal away, in equal numbers: at a corner (<i>vertex</i>) or at a point of an edge (<i>edge</i>), the interval 0.1 %
around the target; at the inside, 1e-7 to 0.1 radians to its plane (<i>grazing</i>); starting on a triangle, at a corner,
an edge or inside (<i>origin</i>); and with tmin or tmax within two floats of a hit (<i>end</i>). Coordinates are floats,
so rays meet their targets but for rounding. Embree promises less than exactness: its interval is closed, and it leaves
hits at its ends and rays in a triangle's plane open. Much of what counts as wrong under
<i>origin</i> and <i>end</i> is within that licence.</p>
<p><b>Speed.</b> One thread, its processor time, one tile of 16x16 pixels a call, every tracer's conversion to its own
rays included; in each round every tracer runs once, medians and quartiles over the rounds. Kernels and frame tracers
learn from other rays: the frame before, from which the camera has moved by 1 % of the diagonal, or adversarial rays of
another seed. What is made beforehand is not in the time (<code>table1</code> has it). Adversarial rays come in no order
that helps anybody.</p>
<p><b>Images</b> have one camera ray through the centre of each pixel, and n shadow rays to points of an area light,
stratified. So all error is the light's. The reference is the mean of two halves with other seeds, and its own noise is
estimated from half their difference. RMSE is over pixels and channels of linear radiance, relMSE is the mean of
(I - R)<sup>2</sup> / (R<sup>2</sup> + 0.01 mean(R)<sup>2</sup>); trimmed means without the 0.1 % worst pixels. Values are
medians over the seeds with quartiles. Bias is the mean of I - R over pixels, with the 95 % interval of Student's t over
seeds, the reference's own uncertainty included; of many such intervals one in twenty leaves out 0 by chance. The time is
that of the whole image, camera rays and shading included, on one thread. All kernels gave the same image, bit for bit, or
there would be no report: kernels differ in time alone, and curves are shifted copies of one another.</p>
)";

}  // namespace umbrix::bench
