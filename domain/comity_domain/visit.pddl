; Visiting people and greeting them, each in their own way.
;
; This file says what comity_domain/visit_domain.py builds; a test keeps the two equal.
; Costs are whole centimetres of walking, or what is worth as much: a disliked option costs
; 100 * weight * -ln(desirability), with the weight in metres and the desirability in [0, 1].

(define (domain visit-domain)
  (:requirements :strips :typing :negative-preconditions :conditional-effects :action-costs)

  (:types
    robot place side modality gesture company turn - object
    user - place)                      ; people are places to be at: the robot stands on one of their sides

  (:predicates
    ; what changes
    (at ?r - robot ?p - place ?s - side)
    (docked ?r - robot ?p - place)     ; near enough to a person, and turned to them, to greet
    (free ?r - robot)                  ; owes nobody a greeting, so it may leave
    (greeted ?u - user)
    (whole ?c - company)               ; nobody of it was greeted alone, so it can be greeted at once
    (now ?k - turn)                    ; how many were greeted, where somebody has a priority; else always the same

    ; what the person and the map allow
    (reachable ?u - user ?s - side)    ; the person accepts this side, and some route leads there
    (permitted ?u - user ?m - modality ?g - gesture)
    (route ?from - place ?from_side - side ?u - user ?s - side)

    ; people who stand together
    (member ?u - user ?c - company)
    (overlooks ?c - company ?u - user ?s - side)               ; all of them can be greeted from there
    (welcome ?c - company ?m - modality ?g - gesture)          ; each of them accepts this greeting

    ; the counting of people
    (then ?k - turn ?next - turn)
    (then_together ?c - company ?k - turn ?next - turn))

  (:functions
    ; one function per action, everything fused into it
    (travel_cost ?from - place ?from_side - side ?u - user ?s - side)    ; the route, and the dislike of the side
    ; the dislike of the greeting, and what it costs that others were greeted before
    (greet_cost ?u - user ?m - modality ?g - gesture ?k - turn)
    ; the same once for all of a company, and the dislike of how near the robot comes to its other members
    (greet_together_cost ?c - company ?u - user ?s - side ?m - modality ?g - gesture ?k - turn)

    ; the parameters bound when the plan is made, rounded; the plan itself carries them with full precision
    (distance_mm ?u - user)
    (speed_mm_s ?u - user)
    (direction_mdeg ?u - user ?s - side)    ; without its sign: positive on the left, negative on the right

    (total-cost))

  ; Go to a person and dock at their conversational distance, from one of their sides.
  ; Binds the distance, the direction and the speed.
  (:action Reach_user
    :parameters (?r - robot ?u - user ?s - side ?from - place ?from_side - side)
    :precondition (and
      (free ?r)
      (at ?r ?from ?from_side)
      (not (greeted ?u))
      (reachable ?u ?s)
      (route ?from ?from_side ?u ?s))
    :effect (and
      (at ?r ?u ?s)
      (docked ?r ?u)
      (not (at ?r ?from ?from_side))
      (not (docked ?r ?from))
      (not (free ?r))                  ; whoever is approached is greeted before the robot goes on
      (increase (total-cost) (travel_cost ?from ?from_side ?u ?s))))

  ; Greet the person the robot is docked to: in words, with a gesture, or both. Words alone take the gesture `none`.
  (:action Greet_person
    :parameters (?r - robot ?u - user ?m - modality ?g - gesture ?k - turn ?next - turn)
    :precondition (and
      (docked ?r ?u)
      (permitted ?u ?m ?g)
      (now ?k)
      (then ?k ?next))
    :effect (and
      (greeted ?u)
      (free ?r)
      (not (now ?k))
      (now ?next)
      (forall (?c - company) (when (member ?u ?c) (not (whole ?c))))
      (increase (total-cost) (greet_cost ?u ?m ?g ?k))))

  ; Greet a whole company by one greeting, docked to one of its members where all of them see and hear the robot.
  (:action Greet_company
    :parameters (?r - robot ?c - company ?u - user ?s - side ?m - modality ?g - gesture ?k - turn ?next - turn)
    :precondition (and
      (docked ?r ?u)
      (at ?r ?u ?s)
      (whole ?c)
      (overlooks ?c ?u ?s)
      (welcome ?c ?m ?g)
      (now ?k)
      (then_together ?c ?k ?next))
    :effect (and
      (not (whole ?c))
      (free ?r)
      (not (now ?k))
      (now ?next)
      (forall (?v - user) (when (member ?v ?c) (greeted ?v)))
      (increase (total-cost) (greet_together_cost ?c ?u ?s ?m ?g ?k)))))
