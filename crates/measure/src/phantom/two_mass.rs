/// A link in the hand, on a spring to a rotor that a weak spring fixes to ground: the source's figure 7-6, and its
/// figure 5-6.
///
/// ```text
/// m_l ẍ_l = F_hand  + k_s (x_m − x_l) + b_s (ẋ_m − ẋ_l)
/// m_m ẍ_m = F_motor + k_s (x_l − x_m) + b_s (ẋ_l − ẋ_m) − k x_m − b ẋ_m
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoMass {
    /// m_l, of the links at the handle [kg].
    pub link_mass: f64,
    /// m_m, of the rotor as the handle feels it [kg].
    pub rotor_mass: f64,
    /// k_s, of the structure between them [N/m].
    pub structure_stiffness: f64,
    /// b_s [N s/m].
    pub structure_damping: f64,
    /// k, between rotor and ground [N/m].
    pub stiffness: f64,
    /// b [N s/m].
    pub damping: f64,
}

impl TwoMass {
    /// The machine of (7.4) to (7.6) with one unit for everything. What the printed coefficients must have
    /// been made of is a rotor of 1.08e-6 kg m² behind 13.3 to 1, links of 3.68e-3 kg m² at 0.215 m, and
    /// 3545 N/m, which is what the maker states; damping and stiffness are those of G₁, the damping of the
    /// structure is set to 3 % of critical.
    pub fn consistent() -> Self {
        let (link_mass, rotor_mass) = (0.0795, 0.00413);
        let structure_stiffness = 3545.0;
        let reduced: f64 = link_mass * rotor_mass / (link_mass + rotor_mass);
        Self {
            link_mass,
            rotor_mass,
            structure_stiffness,
            structure_damping: 0.03 * 2.0 * (structure_stiffness * reduced).sqrt(),
            stiffness: 32.0,
            damping: 2.6,
        }
    }

    /// The frequency at which link and rotor swing against one another, if nothing is damped [Hz].
    pub fn structural_frequency(&self) -> f64 {
        let both = 1.0 / self.link_mass + 1.0 / self.rotor_mass;
        (self.structure_stiffness * both).sqrt() / std::f64::consts::TAU
    }
}
