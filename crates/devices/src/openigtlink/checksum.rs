/// x⁶⁴ + …, as ECMA-182 has it.
const POLYNOMIAL: u64 = 0x42F0_E1EB_A9EA_3693;

const TABLE: [u64; 256] = table();

const fn table() -> [u64; 256] {
    let mut table = [0; 256];
    let mut byte = 0;
    while byte < 256 {
        let mut rest = (byte as u64) << 56;
        let mut bit = 0;
        while bit < 8 {
            let carries = rest >> 63 != 0;
            rest <<= 1;
            if carries {
                rest ^= POLYNOMIAL;
            }
            bit += 1;
        }
        table[byte] = rest;
        byte += 1;
    }
    table
}

/// The checksum of a body: CRC-64 of ECMA-182, from zero, not reflected.
pub fn checksum(body: &[u8]) -> u64 {
    body.iter().fold(0, |sum, byte| {
        let index = (sum >> 56) as u8 ^ byte;
        TABLE[usize::from(index)] ^ (sum << 8)
    })
}
