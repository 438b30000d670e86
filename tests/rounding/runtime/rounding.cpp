// SPDX-License-Identifier: BSD-2-Clause
// The calls that tests/rounding/runtime/as puts into the code. They keep all registers and flags,
// so the compiled code need not know of them: only instructions that leave the flags alone are used
// (mulx, shrx, lea, jrcxz). The code is compiled with -mno-red-zone, because calls write below the
// stack pointer. The state is a linear congruential generator for each thread (Knuth's MMIX).
#include "tests/rounding/runtime/rounding.h"

#include <bit>
#include <cstdlib>
#include <map>
#include <mutex>

extern "C" {
constinit thread_local std::uint64_t exphoton_rounding_state = 1;
constinit thread_local float exphoton_operand = 0, exphoton_result = 0;
std::uint64_t exphoton_rounding_increment = 1;
std::uint64_t exphoton_rounding_multiplier = 6364136223846793005u;
std::uint32_t exphoton_to_nearest = 0x1f80;
extern const double exphoton_zero = 0;  // its first four bytes are a float
std::uint32_t exphoton_directions[2] = {0x1f80, 0x1f80};
std::uint64_t exphoton_is_counting = 0;

void exphoton_count_cancellation(std::uintptr_t address);
}

asm(R"(
	.text
	.globl exphoton_choose_rounding
	.type exphoton_choose_rounding, @function
exphoton_choose_rounding:
	pushq %rax
	pushq %rdx
	movq %fs:exphoton_rounding_state@tpoff, %rdx
	mulx exphoton_rounding_multiplier(%rip), %rax, %rdx
	movq exphoton_rounding_increment(%rip), %rdx
	leaq (%rax,%rdx), %rax
	movq %rax, %fs:exphoton_rounding_state@tpoff
	movl $63, %edx
	shrx %rdx, %rax, %rax
	leaq exphoton_directions(%rip), %rdx
	ldmxcsr (%rdx,%rax,4)
	popq %rdx
	popq %rax
	ret
	.size exphoton_choose_rounding, .-exphoton_choose_rounding

	.globl exphoton_look_for_cancellation
	.type exphoton_look_for_cancellation, @function
exphoton_look_for_cancellation:
	pushq %rcx
	movq exphoton_is_counting(%rip), %rcx
	jrcxz 1f
	pushfq
	pushq %rax
	movl %fs:exphoton_operand@tpoff, %eax
	movl %fs:exphoton_result@tpoff, %ecx
	andl $0x7f800000, %eax
	andl $0x7f800000, %ecx
	subl %ecx, %eax
	cmpl $(13 << 23), %eax
	jl 2f
	call exphoton_save_and_count
2:	popq %rax
	popfq
1:	popq %rcx
	ret
	.size exphoton_look_for_cancellation, .-exphoton_look_for_cancellation

	# On the stack: return address, rax, flags, rcx, the address to count.
	.type exphoton_save_and_count, @function
exphoton_save_and_count:
	pushq %rbp
	movq %rsp, %rbp
	pushq %rdx
	pushq %rsi
	pushq %rdi
	pushq %r8
	pushq %r9
	pushq %r10
	pushq %r11
	subq $520, %rsp
	andq $-16, %rsp
	fxsave64 (%rsp)
	movq 40(%rbp), %rdi
	cld
	call exphoton_count_cancellation
	fxrstor64 (%rsp)
	leaq -56(%rbp), %rsp
	popq %r11
	popq %r10
	popq %r9
	popq %r8
	popq %rdi
	popq %rsi
	popq %rdx
	popq %rbp
	ret
	.size exphoton_save_and_count, .-exphoton_save_and_count
)");

namespace exphoton::rounding {
namespace {

constexpr std::uint32_t kNearest = 0x1f80, kDown = kNearest | 0x2000, kUp = kNearest | 0x4000;

std::mutex countsLock;
std::map<std::uintptr_t, Cancellations> counts;

// Keys that differ in one bit must give unlike states.
std::uint64_t Mix(std::uint64_t x) {
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
  x = (x ^ x >> 27) * 0x94d049bb133111ebu;
  return x ^ x >> 31;
}

[[maybe_unused]] const bool isSeeded = [] {
  if (const char* text = std::getenv("EXPHOTON_ROUNDING_SEED"))
    RoundAtRandom(std::strtoull(text, nullptr, 10));
  return true;
}();

}  // namespace

void RoundAtRandom(std::uint64_t key) {
  exphoton_directions[0] = key == 0 ? kNearest : kDown;
  exphoton_directions[1] = key == 0 ? kNearest : kUp;
  exphoton_rounding_state = Mix(2 * key);
  exphoton_rounding_increment = Mix(2 * key + 1) | 1;
}

void CountCancellations(bool isOn) { exphoton_is_counting = isOn ? 1 : 0; }

std::vector<Cancellations> TakeCancellations() {
  const std::lock_guard guard(countsLock);
  std::vector<Cancellations> all;
  for (const auto& [address, each] : counts) all.push_back(each);
  counts.clear();
  return all;
}

}  // namespace exphoton::rounding

void exphoton_count_cancellation(std::uintptr_t address) {
  using namespace exphoton::rounding;
  const auto exponent = [](float x) { return int(std::bit_cast<std::uint32_t>(x) >> 23 & 0xff); };
  const std::lock_guard guard(countsLock);
  Cancellations& each = counts[address];
  each.address = address;
  if (exphoton_result == 0) {
    ++each.zeros;
  } else {
    ++each.count;
    each.bits += exponent(exphoton_operand) - exponent(exphoton_result);
  }
}
