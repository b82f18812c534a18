#pragma once

/// Plain parameters of the coupling of flow and grains.
namespace livebed::coupling {

/// none: grains and flow ignore each other; one_way: the flow pushes the grains; two_way: and they push back.
enum class Mode { none, one_way, two_way };

/// How the fluid takes the drag.  implicit: beta (U - u_p) inside the momentum step, the difference to the true impulse
/// carried to the next step; lagged: the whole impulse of the last step as a source (the paper, Sec. 4.1).
enum class Exchange { implicit, lagged };

/// paper: C_D = C_Dinf + 24/Re_p on the slip (Eq. 15-18).
enum class Drag { paper };

/// Does the void fraction enter the fluid equations?  off: no (the paper).
enum class Voidage { off };

struct Params {
  Mode mode = Mode::two_way;
  Exchange exchange = Exchange::implicit;
  Drag drag = Drag::paper;
  Voidage voidage = Voidage::off;
  double drag_infinity = 0.4;  ///< C_D infinity [-] (Table 2)
  double kernel = 2;           ///< half-width of the transfer kernel over the grain diameter [-]
};

}  // namespace livebed::coupling
